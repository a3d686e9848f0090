#include "evaluation/summary_json.h"

#include <nlohmann/json.hpp>

namespace ringhook {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const ErrorStatistics& e) {
  return {{"mean", e.mean}, {"std", e.std}, {"rms", e.rms}, {"max", e.max}};
}

Json toJson(const SequenceSummary& summary) {
  Json json;
  json["frames"] = summary.frames;
  json["frames_tracked"] = summary.frames_tracked;
  json["losses"] = summary.losses;
  json["reacquisitions"] = summary.reacquisitions;
  if (summary.false_poses) {
    json["false_poses"] = *summary.false_poses;
  }
  if (summary.position_error_mm) {
    json["position_error_mm"] = toJson(*summary.position_error_mm);
  }
  if (summary.rotation_error_deg) {
    json["rotation_error_deg"] = toJson(*summary.rotation_error_deg);
  }
  json["stage_ms"] = Json::object();
  for (const auto& [name, times] : summary.stages) {
    json["stage_ms"][name] = {{"p50", times.p50_ms}, {"p95", times.p95_ms}, {"p99", times.p99_ms}};
  }
  return json;
}

}  // namespace

std::string summaryJson(const std::vector<SequenceSummary>& summaries, const std::string& sequence,
                        double gate_mm, bool interrupted) {
  Json json = toJson(summaries.front());
  json["sequence"] = sequence;
  json["method"] = summaries.front().method;
  json["gate_mm"] = gate_mm;
  json["interrupted"] = interrupted;
  json["methods"] = Json::object();
  for (const auto& summary : summaries) {
    json["methods"][summary.method] = toJson(summary);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ringhook
