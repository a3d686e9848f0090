#include "calib/wizard/arm_poses.h"

#include <array>

namespace ringhook {
namespace {

/// Corners of a cube such that each differs from the one before along one edge (Gray code).
constexpr std::array<std::array<int, 3>, 8> kCorners = {{{-1, -1, -1},
                                                         {1, -1, -1},
                                                         {1, 1, -1},
                                                         {-1, 1, -1},
                                                         {-1, 1, 1},
                                                         {1, 1, 1},
                                                         {1, -1, 1},
                                                         {-1, -1, 1}}};

/// Axes of the turns, in the flange, three at each corner: about one axis, about another, about a
/// mixture; signs alternate so that no direction is left out.
Eigen::Vector3d turnAxis(std::size_t corner, std::size_t turn) {
  const double sign = corner % 2 == 0 ? 1.0 : -1.0;
  const double other = corner / 2 % 2 == 0 ? 1.0 : -1.0;
  const std::array<Eigen::Vector3d, 3> axes = {Eigen::Vector3d(sign, 0.0, 0.3 * other),
                                               Eigen::Vector3d(0.3 * other, sign, 0.0),
                                               Eigen::Vector3d(0.5 * other, -0.5 * sign, sign)};
  return axes.at(turn).normalized();
}

}  // namespace

std::vector<Pose> armPoses(const Pose& start, const ArmPoseOptions& options) {
  std::vector<Pose> poses;
  for (std::size_t corner = 0; corner < kCorners.size(); ++corner) {
    const auto& c = kCorners.at(corner);
    for (std::size_t turn = 0; turn < 3; ++turn) {
      Pose fMe = start;
      fMe.translation() += 0.5 * options.side_m * Eigen::Vector3d(c[0], c[1], c[2]);
      fMe.linear() = start.linear() *
                     Eigen::AngleAxisd(options.turn_rad, turnAxis(corner, turn)).toRotationMatrix();
      poses.push_back(fMe);
    }
  }
  return poses;
}

}  // namespace ringhook
