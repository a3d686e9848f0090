#pragma once

/// \file
/// The counts and statistics of one method over one sequence, as the tables and summary.json tell
/// them. A loss is a tracked frame followed by one that is not; a reacquisition is the way back.

#include <map>
#include <optional>
#include <string>

#include "evaluation/pose_error.h"
#include "evaluation/sequence_evaluation.h"

namespace ringhook {

struct StageTimes {
  double p50_ms = 0.0;
  double p95_ms = 0.0;
  double p99_ms = 0.0;
};

struct SequenceSummary {
  std::string method;
  std::size_t frames = 0;
  std::size_t frames_tracked = 0;
  std::size_t losses = 0;
  std::size_t reacquisitions = 0;
  std::optional<std::size_t> false_poses;             ///< absent without truth
  std::optional<ErrorStatistics> position_error_mm;   ///< absent without truth
  std::optional<ErrorStatistics> rotation_error_deg;  ///< absent without truth
  std::map<std::string, StageTimes> stages;           ///< read, rectify, track, fix
};

/// \param gate_mm a tracked pose wronger than this is a false pose.
[[nodiscard]] SequenceSummary summarise(const MethodRun& run, double gate_mm);

/// The table that the command prints, one line a method.
[[nodiscard]] std::string summaryTable(const std::vector<SequenceSummary>& summaries);

}  // namespace ringhook
