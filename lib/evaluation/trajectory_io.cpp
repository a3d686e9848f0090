#include "evaluation/trajectory_io.h"

#include <cmath>
#include <cstdio>
#include <fstream>

#include "camera/csv_table.h"
#include "core/atomic_file.h"
#include "core/error.h"

namespace ringhook {
namespace {

StampedPose poseOfLine(const std::string& line, const std::string& where) {
  const std::vector<double> v = numbersOfLine(line, where);
  if (v.size() != 8) {
    throw InputError(where + ": expected time tx ty tz qx qy qz qw, found " +
                     std::to_string(v.size()) + " numbers");
  }
  if (std::abs(v[0]) > 9e9) {  // the clock's nanoseconds end there
    throw InputError(where + ": expected a time in seconds");
  }
  const Eigen::Quaterniond rotation(v[7], v[4], v[5], v[6]);
  if (std::abs(rotation.norm() - 1.0) > 0.01) {
    throw InputError(where + ": expected a quaternion of norm 1, found norm " +
                     std::to_string(rotation.norm()));
  }
  return {Time::fromSeconds(v[0]), makePose({v[1], v[2], v[3]}, rotation)};
}

}  // namespace

void writeTum(const std::filesystem::path& file, const std::vector<StampedPose>& poses) {
  std::string text = "# time tx ty tz qx qy qz qw (s, m)\n";
  for (const auto& [time, pose] : poses) {
    const Eigen::Vector3d p = pose.translation();
    const Eigen::Quaterniond q(pose.linear());
    char line[256];
    std::snprintf(line, sizeof(line), "%.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", time.seconds(),
                  p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
    text += line;
  }
  writeFileAtomically(file, text);
}

std::vector<StampedPose> readTum(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    throw InputError("cannot read " + file.string() + ": expected a TUM trajectory");
  }
  std::vector<StampedPose> poses;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with("#")) {
      continue;
    }
    const std::string where = file.string() + " line " + std::to_string(number);
    poses.push_back(poseOfLine(line, where));
    if (poses.size() > 1 && !(poses.back().time > poses[poses.size() - 2].time)) {
      throw InputError(where + ": time must grow from line to line");
    }
  }
  if (poses.empty()) {
    throw InputError(file.string() + " holds no pose: expected time tx ty tz qx qy qz qw");
  }
  return poses;
}

}  // namespace ringhook
