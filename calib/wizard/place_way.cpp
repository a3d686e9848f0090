#include "calib/wizard/place_way.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "robot/rx60/kinematics.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;

constexpr double kStep = 0.03;            // of the joint that turns most [rad]
constexpr double kFloor = 0.10;           // height to keep [m]
constexpr double kPedestalRadius = 0.16;  // around the axis of joint 1 [m],
constexpr double kPedestalHeight = 0.45;  // up to here [m]
constexpr double kBeltDistance = 0.12;    // from the line of the pivots [m]
constexpr double kBeyondTool = 0.03;      // a ring's other side, beyond its centre [m]
constexpr double kPlateEdge = 0.13;       // of the gripper's plate, along -x_e [m]

/// Points that must keep clear, in f; the elbow comes first.
std::array<Vector3d, 5> armPoints(const CellConfig& cell, const JointVector& q) {
  const rx60::LinkPoints links = rx60::linkPoints(rx60::rx60(), q);
  const Pose fMe = rx60::forward(rx60::rx60(), q);
  const Vector3d tool_e = cell.arm.eMr.translation();
  return {links.elbow, links.wrist, links.flange,
          fMe * Vector3d(tool_e + kBeyondTool * Vector3d::UnitZ()),
          fMe * Vector3d(-kPlateEdge, 0.0, 0.5 * tool_e.z())};
}

double toBelt(const BeltConfig& belt, const Vector3d& point_f) {
  return (point_f - belt.pivot_start_f).cross(belt.direction_f).norm();
}

std::optional<std::string> touches(const CellConfig& cell, const JointVector& q) {
  const auto points = armPoints(cell, q);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d& p = points[i];
    if (p.z() < kFloor) {
      return "the floor is in the way";
    }
    if (i > 0 && p.z() < kPedestalHeight && p.head<2>().norm() < kPedestalRadius) {
      return "the arm's own pedestal is in the way";
    }
    if (toBelt(cell.belt, p) < kBeltDistance) {
      return "the belt is in the way";
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> inTheWay(const CellConfig& cell, const JointVector& start,
                                    const JointVector& end) {
  const double longest = (end - start).cwiseAbs().maxCoeff();
  const int steps = std::max(1, static_cast<int>(std::ceil(longest / kStep)));
  for (int i = 1; i <= steps; ++i) {
    if (auto what = touches(cell, start + (static_cast<double>(i) / steps) * (end - start))) {
      return what;
    }
  }
  return std::nullopt;
}

}  // namespace ringhook
