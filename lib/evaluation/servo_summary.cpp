#include "evaluation/servo_summary.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

namespace ringhook {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMm = 1e3;

Json inUnit(const Statistics& s, double factor) {
  if (s.count() == 0) {
    return Json();
  }
  return {{"mean", s.mean() * factor},
          {"std", s.std() * factor},
          {"rms", s.rms() * factor},
          {"max", s.max() * factor},
          {"samples", s.count()}};
}

Statistics over(const ServoReport& report, Statistics AttemptResult::*of) {
  Statistics all;
  for (const ServoAttempt& attempt : report.attempts) {
    all.merge(attempt.loop.*of);
  }
  return all;
}

std::string outcomeInWords(const ServoAttempt& attempt) {
  if (!attempt.loop.released) {
    return "aborted: " + attempt.loop.abort_reason;
  }
  return attempt.truth.hanging ? "ring hangs" : "ring fell";
}

double duration(const AttemptResult& result) { return result.ended - result.started; }

Json attemptJson(const ServoAttempt& attempt) {
  Json json = {{"outcome", outcomeInWords(attempt)},
               {"released", attempt.loop.released},
               {"hanging", attempt.truth.hanging},
               {"duration_s", duration(attempt.loop)},
               {"peak_contact_n", attempt.truth.peak_contact_n}};
  if (attempt.loop.met && attempt.loop.released_at) {
    json["approach_to_release_s"] = *attempt.loop.released_at - *attempt.loop.met;
  }
  json["tracking_error_mm"] = inUnit(attempt.loop.tracking_error_m, kMm);
  json["true_insertion_error_mm"] = inUnit(attempt.truth.insertion_error_m, kMm);
  return json;
}

}  // namespace

int ringsHung(const ServoReport& report) {
  return static_cast<int>(
      std::count_if(report.attempts.begin(), report.attempts.end(),
                    [](const ServoAttempt& attempt) { return attempt.truth.hanging; }));
}

std::string servoTableHead() {
  return "hook  outcome                                   cycle   following    true      contact\n"
         "                                                   s    max mm   error mm    peak N\n";
}

std::string servoTableRow(int attempt, const ServoAttempt& result) {
  char line[160];
  std::snprintf(line, sizeof line, "%4d  %-40.40s %6.1f  %8.2f  %9.2f  %8.2f\n", attempt + 1,
                outcomeInWords(result).c_str(), duration(result.loop),
                result.loop.tracking_error_m.max() * kMm,
                result.truth.insertion_error_m.max() * kMm, result.truth.peak_contact_n);
  return line;
}

std::string servoSummaryJson(const ServoJob& job, const ServoReport& report) {
  Statistics cycle_time;
  double peak_contact = 0.0;
  std::map<std::string, int> aborts;
  Json attempts = Json::array();
  for (const ServoAttempt& attempt : report.attempts) {
    cycle_time.add(duration(attempt.loop));
    peak_contact = std::max(peak_contact, attempt.truth.peak_contact_n);
    if (!attempt.loop.released) {
      ++aborts[attempt.loop.abort_reason];
    }
    attempts.push_back(attemptJson(attempt));
  }
  const LoopStatistics& loop = report.statistics;
  Json json = {{"rings_hung", ringsHung(report)},
               {"cycles", report.attempts.size()},
               {"cycles_asked", job.cycles},
               {"interrupted", report.interrupted},
               {"cell", report.cell},
               {"simulated", true},
               {"judged_by", "simulated physics, 2 s after the release"},
               {"scenario", report.scenario},
               {"tracker", job.tracker == TrackerKind::kMarker ? "marker" : "edges"},
               {"seed", job.seed},
               {"arm_link", job.arm_link == ArmLink::kRx60 ? "rx60" : "direct"},
               {"cycle_time_s", cycle_time.mean()},
               {"peak_contact_n", peak_contact},
               {"aborts", aborts},
               {"tracking_error_mm", inUnit(over(report, &AttemptResult::tracking_error_m), kMm)},
               {"prediction_error_mm", inUnit(loop.prediction_error_m, kMm)},
               {"prediction_horizon_s", 0.1},
               {"true_fix_error_mm", inUnit(loop.fix_error_m, kMm)},
               {"limit_violations", loop.limit_violations},
               {"limited_commands", loop.limited_commands},
               {"latency_ms", inUnit(loop.frame_age_s, 1e3)},
               {"nis_mean", loop.nis.mean()},
               {"frames_tracked", loop.frames - loop.frames_without_fix},
               {"frames_missed", loop.frames_without_fix},
               {"attempts", attempts}};
  return json.dump(2) + "\n";
}

}  // namespace ringhook
