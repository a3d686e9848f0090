#include "calib/solve/pose_table.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "calib/solve/pose_pairs.h"
#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kQuaternionTolerance = 0.01;  // a few printed digits

std::string shortText(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

[[noreturn]] void refuseMillimetres(const std::string& where, double value) {
  throw InputError(where + ": expected metres, found " + shortText(value) +
                   ", which looks like millimetres (a robot cell is smaller than " +
                   shortText(kFarthestPosition) + " m)");
}

[[noreturn]] void refuseQuaternion(const std::string& where, const Eigen::Vector4d& q) {
  const bool angles = q.cwiseAbs().maxCoeff() > 1.5;
  throw InputError(where + ": expected a quaternion x, y, z, w of length 1, found length " +
                   shortText(q.norm()) + (angles ? ", which looks like angles in degrees" : ""));
}

// One value of ViSP's file: "  - [0.719437]" or "  - 0.719437".
std::optional<double> valueOfLine(const std::string& line) {
  std::string text;
  for (const char c : line) {
    const bool bracket = c == '[' || c == ']' || c == ' ' || c == '\t' || c == '\r';
    text += bracket ? "" : std::string(1, c);
  }
  return text.size() > 1 && text.front() == '-' ? numberFromText(text.substr(1)) : std::nullopt;
}

Pose checkedVispPose(const std::filesystem::path& file, const std::vector<double>& v,
                     const std::vector<std::size_t>& lines) {
  const auto where = [&](std::size_t i) {
    return file.string() + " line " + std::to_string(lines[i]);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(v[i]) > kFarthestPosition) {
      refuseMillimetres(where(i), v[i]);
    }
  }
  const Eigen::Vector3d theta_u(v[3], v[4], v[5]);
  if (theta_u.norm() > 2.0 * kPi) {
    throw InputError(where(3) + ": expected a rotation vector in radians, found length " +
                     shortText(theta_u.norm()) + ", which looks like degrees");
  }
  return makePoseThetaU({v[0], v[1], v[2]}, theta_u);
}

}  // namespace

void requireRows(const CsvTable& table, const std::filesystem::path& file) {
  if (table.rows() == 0) {
    throw InputError(file.string() + ": expected at least one row below the header");
  }
}

std::string rowName(const CsvTable& table, std::size_t row) {
  const std::string where = table.where(row, 0);
  const std::string place = where.substr(0, where.rfind(", column"));
  return place.substr(place.find_last_of('/') + 1);
}

PointColumns::PointColumns(const CsvTable& table, const std::string& prefix)
    : table_(table),
      columns_{table.column(prefix + "x"), table.column(prefix + "y"), table.column(prefix + "z")} {
}

Eigen::Vector3d PointColumns::read(std::size_t row) const {
  Eigen::Vector3d point;
  for (int i = 0; i < 3; ++i) {
    const std::size_t column = columns_[static_cast<std::size_t>(i)];
    point[i] = table_.number(row, column);
    if (std::abs(point[i]) > kFarthestPosition) {
      refuseMillimetres(table_.where(row, column), point[i]);
    }
  }
  return point;
}

PoseColumns::PoseColumns(const CsvTable& table, const std::string& prefix)
    : table_(table),
      position_(table, prefix),
      rotation_{table.column(prefix + "qx"), table.column(prefix + "qy"),
                table.column(prefix + "qz"), table.column(prefix + "qw")} {}

Pose PoseColumns::read(std::size_t row) const {
  Eigen::Vector4d q;
  for (int i = 0; i < 4; ++i) {
    q[i] = table_.number(row, rotation_[static_cast<std::size_t>(i)]);
  }
  if (std::abs(q.norm() - 1.0) > kQuaternionTolerance) {
    refuseQuaternion(table_.where(row, rotation_[0]), q);
  }
  return makePose(position_.read(row), Eigen::Quaterniond(q[3], q[0], q[1], q[2]));
}

Pose readVispPose(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream || isFolder(file)) {
    throw InputError("cannot read " + file.string() + ": expected a pose file of ViSP");
  }
  std::vector<double> values;
  std::vector<std::size_t> lines;
  std::string line;
  bool data = false;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (line.starts_with("data:")) {
      data = true;
      continue;
    }
    if (!data || line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with("#")) {
      continue;
    }
    const auto value = valueOfLine(line);
    if (!value) {
      throw InputError(file.string() + " line " + std::to_string(number) +
                       ": expected '- [NUMBER]', found '" + line + "'");
    }
    values.push_back(*value);
    lines.push_back(number);
  }
  if (values.size() != 6) {
    throw InputError(file.string() + ": expected 'data:' with six values x, y, z in metres and a " +
                     "rotation vector in radians, found " + std::to_string(values.size()));
  }
  return checkedVispPose(file, values, lines);
}

JointColumns::JointColumns(const CsvTable& table) : table_(table) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    columns_.at(i) = table.column("j" + std::to_string(i + 1) + "_rad");
  }
}

JointVector JointColumns::read(std::size_t row) const {
  JointVector joints;
  for (int i = 0; i < joints.size(); ++i) {
    joints(i) = table_.number(row, columns_.at(static_cast<std::size_t>(i)));
  }
  return joints;
}

std::vector<ArmRow> readArmRows(const std::filesystem::path& file) {
  const CsvTable table(file);
  const JointColumns joints(table);
  const PoseColumns poses(table, "");
  std::vector<ArmRow> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    rows.push_back({joints.read(row), poses.read(row)});
  }
  return rows;
}

std::vector<Pose> readPoseTable(const std::filesystem::path& file) {
  const CsvTable table(file);
  const PoseColumns columns(table, "");
  requireRows(table, file);
  std::vector<Pose> poses;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    poses.push_back(columns.read(row));
  }
  return poses;
}

}  // namespace ringhook
