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
  if (!attempt.truth) {
    return attempt.loop.tries > 1 ? "ring released, try " + std::to_string(attempt.loop.tries)
                                  : "ring released";
  }
  return attempt.truth->hanging ? "ring hangs" : "ring fell";
}

double duration(const AttemptResult& result) { return result.ended - result.started; }

Json attemptJson(const ServoAttempt& attempt) {
  Json json = {{"outcome", outcomeInWords(attempt)},
               {"released", attempt.loop.released},
               {"tries", attempt.loop.tries},
               {"duration_s", duration(attempt.loop)}};
  if (attempt.loop.met && attempt.loop.released_at) {
    json["approach_to_release_s"] = *attempt.loop.released_at - *attempt.loop.met;
  }
  json["tracking_error_mm"] = inUnit(attempt.loop.tracking_error_m, kMm);
  if (attempt.truth) {
    json["hanging"] = attempt.truth->hanging;
    json["peak_contact_n"] = attempt.truth->peak_contact_n;
    json["true_insertion_error_mm"] = inUnit(attempt.truth->insertion_error_m, kMm);
  }
  return json;
}

Json camerasJson(const AravisCounts& counts) {
  return {{"pairs", counts.pairs},
          {"unpaired_left", counts.unpaired_left},
          {"unpaired_right", counts.unpaired_right},
          {"lost_left", counts.left.lost_images},
          {"lost_right", counts.right.lost_images},
          {"missing_packets", counts.left.missing_packets + counts.right.missing_packets}};
}

Json linkJson(const rx60::LinkReport& link) {
  return {{"commands", link.commands},
          {"left_out", link.left_out},
          {"missed_cycles", link.arrivals.missed_cycles},
          {"period_ms", link.arrivals.period_s * 1e3},
          {"jitter_ms", link.arrivals.jitter_s * 1e3},
          {"faults", link.faults},
          {"last_fault", link.last_fault}};
}

/// Who says whether rings hang, and how the devices were reached.
void addJudge(const ServoJob& job, const ServoReport& report, Json& json) {
  if (!report.live) {
    json["simulated"] = true;
    json["judged_by"] = "simulated physics, 2 s after the release";
    json["scenario"] = report.scenario;
    json["seed"] = job.seed;
    json["arm_link"] = job.arm_link == ArmLink::kRx60 ? "rx60" : "direct";
    return;
  }
  json["judged_by"] = "nobody: the loop knows that it let go, not that the ring hangs";
  json["failure"] = report.failure.empty() ? Json() : Json(report.failure);
  json["cameras"] = camerasJson(report.live->cameras);
  json["frames_passed_over"] = report.live->frames_passed_over;
  json["frame_interval_ms"] = inUnit(report.live->frame_interval_s, 1e3);
  json["arm"] = linkJson(report.live->arm);
  json["arm"]["thread_priority"] = nameOf(report.live->link_priority);
}

/// What the attempts have in common.
struct AllAttempts {
  Statistics cycle_time;
  double peak_contact = 0.0;
  std::map<std::string, int> aborts;  ///< by reason
  Json list = Json::array();
};

AllAttempts sumUp(const std::vector<ServoAttempt>& attempts) {
  AllAttempts all;
  for (const ServoAttempt& attempt : attempts) {
    all.cycle_time.add(duration(attempt.loop));
    if (attempt.truth) {
      all.peak_contact = std::max(all.peak_contact, attempt.truth->peak_contact_n);
    }
    if (!attempt.loop.released) {
      ++all.aborts[attempt.loop.abort_reason];
    }
    all.list.push_back(attemptJson(attempt));
  }
  return all;
}

}  // namespace

int ringsHung(const ServoReport& report) {
  return static_cast<int>(
      std::count_if(report.attempts.begin(), report.attempts.end(),
                    [](const ServoAttempt& a) { return a.truth && a.truth->hanging; }));
}

int ringsReleased(const ServoReport& report) {
  return static_cast<int>(std::count_if(report.attempts.begin(), report.attempts.end(),
                                        [](const ServoAttempt& a) { return a.loop.released; }));
}

std::string servoTableHead() {
  return "hook  outcome                                   cycle   following    true      contact\n"
         "                                                   s    max mm   error mm    peak N\n";
}

std::string servoTableRow(int attempt, const ServoAttempt& result) {
  char line[160];
  std::snprintf(line, sizeof line, "%4d  %-40.40s %6.1f  %8.2f", attempt + 1,
                outcomeInWords(result).c_str(), duration(result.loop),
                result.loop.tracking_error_m.max() * kMm);
  std::string row = line;
  if (result.truth) {
    std::snprintf(line, sizeof line, "  %9.2f  %8.2f", result.truth->insertion_error_m.max() * kMm,
                  result.truth->peak_contact_n);
    row += line;
  } else {
    row += "          -         -";
  }
  return row + "\n";
}

std::string servoSummaryJson(const ServoJob& job, const ServoReport& report) {
  const AllAttempts all = sumUp(report.attempts);
  const LoopStatistics& loop = report.statistics;
  const bool judged = !report.live;
  Json json = {{"rings_hung", judged ? Json(ringsHung(report)) : Json()},
               {"rings_released", ringsReleased(report)},
               {"cycles", report.attempts.size()},
               {"cycles_asked", job.cycles},
               {"interrupted", report.interrupted},
               {"cell", report.cell},
               {"tracker", job.tracker == TrackerKind::kMarker ? "marker" : "edges"}};
  addJudge(job, report, json);
  json["cycle_time_s"] = all.cycle_time.mean();
  json["peak_contact_n"] = judged ? Json(all.peak_contact) : Json();
  json["aborts"] = all.aborts;
  json["tracking_error_mm"] = inUnit(over(report, &AttemptResult::tracking_error_m), kMm);
  json["prediction_error_mm"] = inUnit(loop.prediction_error_m, kMm);
  json["prediction_horizon_s"] = 0.1;
  if (judged) {
    json["true_fix_error_mm"] = inUnit(loop.fix_error_m, kMm);
  }
  json["limit_violations"] = loop.limit_violations;
  json["limited_commands"] = loop.limited_commands;
  json["latency_ms"] = inUnit(loop.frame_age_s, 1e3);
  json["nis_mean"] = loop.nis.mean();
  json["frames_tracked"] = loop.frames - loop.frames_without_fix;
  json["frames_missed"] = loop.frames_without_fix;
  json["attempts"] = all.list;
  return json.dump(2) + "\n";
}

}  // namespace ringhook
