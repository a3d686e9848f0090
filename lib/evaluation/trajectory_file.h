#pragma once

/// \file
/// A recorded trajectory of angles or points (doc/formats.md, "trajectory.csv"). The names in the
/// header decide what it is: `angle_rad[,angle2_rad]`, a swing about a fixed pivot with hanging =
/// 0; or `x,y,z` [m], z up, with `pivot_x,pivot_y,pivot_z` or without. Other columns are read over.

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "prediction/motion_model.h"

namespace ringhook {

struct Trajectory {
  std::string name;  ///< of the file, without its extension
  TrajectoryKind kind = TrajectoryKind::kAngle;
  std::vector<Time> times;              ///< strictly growing, at least two
  std::vector<Eigen::VectorXd> values;  ///< valueSize(kind) numbers each [rad or m], finite
};

struct TrajectoryFileOptions {
  /// Other names for the format's columns: {"x", "load_x"} reads x from the column load_x.
  std::map<std::string, std::string> columns;
  std::optional<double> rate_hz;  ///< of a file without time_s
};

/// Throws InputError naming file, line and column: no such columns, angles and points in one file,
/// a part of a point, no time and no rate or both, time that does not grow, a number that is none
/// or is beyond 1e6 (nanoseconds of time beyond the clock), fewer than two samples; and naming
/// --columns for a name that the format does not know.
[[nodiscard]] Trajectory readTrajectory(const std::filesystem::path& file,
                                        const TrajectoryFileOptions& options);

/// Names of what is predicted, for tables: angle_rad, angle2_rad or x, y, z.
[[nodiscard]] std::vector<std::string> predictedNames(TrajectoryKind kind);

/// Samples whose numbers are all those of the sample before: a source that held its last value.
[[nodiscard]] std::size_t repeatedSamples(const Trajectory& trajectory);

/// The trajectory without its repeated samples.
[[nodiscard]] Trajectory withoutRepeated(const Trajectory& trajectory);

/// Middle of the times between samples [s].
[[nodiscard]] double medianStep(const Trajectory& trajectory);

}  // namespace ringhook
