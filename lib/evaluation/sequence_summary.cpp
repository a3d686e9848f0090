#include "evaluation/sequence_summary.h"

#include <cstdio>

#include "core/angle.h"

namespace ringhook {
namespace {

constexpr double kMillimetres = 1e3;

StageTimes stageTimes(const std::vector<FrameRecord>& frames, double FrameRecord::*seconds) {
  std::vector<double> times_ms;
  times_ms.reserve(frames.size());
  for (const auto& frame : frames) {
    times_ms.push_back(frame.*seconds * 1e3);
  }
  return {percentile(times_ms, 50.0), percentile(times_ms, 95.0), percentile(times_ms, 99.0)};
}

void countStates(const std::vector<FrameRecord>& frames, SequenceSummary& summary) {
  bool tracked_before = false;
  bool ever = false;
  for (const auto& frame : frames) {
    const bool tracked = frame.fix.has_value();
    summary.frames_tracked += tracked ? 1 : 0;
    summary.losses += tracked_before && !tracked ? 1 : 0;
    summary.reacquisitions += ever && !tracked_before && tracked ? 1 : 0;
    ever = ever || tracked;
    tracked_before = tracked;
  }
}

}  // namespace

SequenceSummary summarise(const MethodRun& run, double gate_mm) {
  SequenceSummary summary;
  summary.method = run.name;
  summary.frames = run.frames.size();
  countStates(run.frames, summary);
  std::vector<double> position;
  std::vector<double> rotation;
  std::size_t wrong = 0;
  for (const auto& frame : run.frames) {
    if (frame.position_error) {
      position.push_back(*frame.position_error * kMillimetres);
      rotation.push_back(*frame.rotation_error / kDegree);
      wrong += position.back() > gate_mm ? 1 : 0;
    }
  }
  if (!position.empty()) {
    summary.false_poses = wrong;
    summary.position_error_mm = errorStatistics(position);
    summary.rotation_error_deg = errorStatistics(rotation);
  }
  if (!run.frames.empty()) {
    summary.stages["read"] = stageTimes(run.frames, &FrameRecord::read_s);
    summary.stages["rectify"] = stageTimes(run.frames, &FrameRecord::rectify_s);
    summary.stages["track"] = stageTimes(run.frames, &FrameRecord::track_s);
    summary.stages["fix"] = stageTimes(run.frames, &FrameRecord::fix_s);
  }
  return summary;
}

std::string summaryTable(const std::vector<SequenceSummary>& summaries) {
  std::string table =
      "method           frames tracked losses back  position error [mm]       rotation error [deg]"
      "      track+fix [ms]\n"
      "                                             mean   std    max         mean   std    max   "
      "      p50    p95\n";
  for (const auto& s : summaries) {
    char line[256];
    std::snprintf(line, sizeof(line), "%-16s %6zu %7zu %6zu %4zu  ", s.method.c_str(), s.frames,
                  s.frames_tracked, s.losses, s.reacquisitions);
    table += line;
    if (s.position_error_mm && s.rotation_error_deg) {
      std::snprintf(line, sizeof(line), "%6.3f %6.3f %6.3f      %6.3f %6.3f %6.3f   ",
                    s.position_error_mm->mean, s.position_error_mm->std, s.position_error_mm->max,
                    s.rotation_error_deg->mean, s.rotation_error_deg->std,
                    s.rotation_error_deg->max);
      table += line;
    } else {
      table += "no truth                  no truth               ";
    }
    if (!s.stages.empty()) {
      const auto& track = s.stages.at("track");
      const auto& fix = s.stages.at("fix");
      std::snprintf(line, sizeof(line), "%7.2f %6.2f", track.p50_ms + fix.p50_ms,
                    track.p95_ms + fix.p95_ms);
      table += line;
    }
    table += "\n";
  }
  return table;
}

}  // namespace ringhook
