#pragma once

/// \file
/// Poses and points in tables and small files that people write by hand or export from a robot's
/// controller, and the mistakes that come with them: millimetres, degrees, quaternions in another
/// order. Each mistake gets its own sentence.

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "camera/csv_table.h"
#include "core/joints.h"
#include "core/pose.h"

namespace ringhook {

/// Throws InputError if the table has a header only.
void requireRows(const CsvTable& table, const std::filesystem::path& file);

/// A row for messages: "pairs.csv line 5".
std::string rowName(const CsvTable& table, std::size_t row);

/// Three columns PREFIXx, PREFIXy, PREFIXz [m].
class PointColumns {
 public:
  /// Throws InputError if a column is missing. The table must outlive the columns.
  PointColumns(const CsvTable& table, const std::string& prefix);
  /// Throws InputError for a value that is no finite number or looks like millimetres.
  [[nodiscard]] Eigen::Vector3d read(std::size_t row) const;

 private:
  const CsvTable& table_;
  std::array<std::size_t, 3> columns_;
};

/// Seven columns PREFIXx .. PREFIXqw: position [m], quaternion x, y, z, w.
class PoseColumns {
 public:
  /// Throws InputError if a column is missing. The table must outlive the columns.
  PoseColumns(const CsvTable& table, const std::string& prefix);
  /// Throws InputError likewise, and for a quaternion that is not of length 1.
  [[nodiscard]] Pose read(std::size_t row) const;

 private:
  const CsvTable& table_;
  PointColumns position_;
  std::array<std::size_t, 4> rotation_;
};

/// Six columns j1_rad .. j6_rad.
class JointColumns {
 public:
  /// Throws InputError if a column is missing. The table must outlive the columns.
  explicit JointColumns(const CsvTable& table);
  /// [rad]. Throws InputError for a value that is no finite number.
  [[nodiscard]] JointVector read(std::size_t row) const;

 private:
  const CsvTable& table_;
  std::array<std::size_t, 6> columns_{};
};

/// Where an arm stood, a row of robot.csv; its time is not read.
struct ArmRow {
  JointVector joints = JointVector::Zero();  ///< reported [rad]
  Pose fMe = Pose::Identity();               ///< flange in the robot reference
};

/// Every row of robot.csv (doc/formats.md). Throws InputError as the columns do.
std::vector<ArmRow> readArmRows(const std::filesystem::path& file);

/// ViSP's pose file (vpPoseVector): `rows: 6`, `cols: 1`, `data:` with x, y, z [m] and the rotation
/// vector [rad], one value a line. Throws InputError naming file and line.
Pose readVispPose(const std::filesystem::path& file);

/// Flange poses from the columns x .. qw of a table (robot.csv), one a row.
std::vector<Pose> readPoseTable(const std::filesystem::path& file);

}  // namespace ringhook
