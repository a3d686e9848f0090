#pragma once

/// \file
/// What `ringhook evaluate trajectory` prints and writes (doc/evaluation.md): a table,
/// summary.json, frames.csv and report.html. Tables and charts are in millimetres and milliradians,
/// files in metres and radians.

#include <filesystem>
#include <string>

#include "evaluation/trajectory_result.h"

namespace ringhook {

/// For a terminal.
[[nodiscard]] std::string trajectoryTable(const TrajectoryResult& result);

/// summary.json: the main model at the top level, every model's results under `models`.
[[nodiscard]] std::string trajectoryJson(const TrajectoryResult& result);

/// One row a sample: time, measured numbers; of each model its NIS, its parameters and, by horizon,
/// the errors of what it predicted after this sample. A field is empty where there is nothing.
[[nodiscard]] std::string trajectoryCsv(const TrajectoryResult& result);

/// The three files. Throws Error.
void writeTrajectoryOutputs(const std::filesystem::path& folder, const TrajectoryResult& result);

}  // namespace ringhook
