#include "cycle/belt_geometry.h"

#include <cmath>

#include "prediction/hanging_pose.h"

namespace ringhook {

Pose hookOnBelt(const CellConfig& cell, double travel_m, double swing_x_rad, double swing_y_rad) {
  HangingPose hanging;
  hanging.pivot_f = cell.belt.pivot_start_f + travel_m * cell.belt.direction_f;
  hanging.swing_x = swing_x_rad;
  hanging.swing_y = swing_y_rad;
  return poseFromHanging(hanging, cell.hook.pivot_o);
}

double hookTravel(const CellConfig& cell, const Pose& fMo) {
  const Eigen::Vector3d pivot_f = fMo * cell.hook.pivot_o;
  return (pivot_f - cell.belt.pivot_start_f).dot(cell.belt.direction_f);
}

double hookTravelSpeed(const CellConfig& cell, const HookEstimate& hook) {
  const Eigen::Vector3d arm_f = hook.fMo.linear() * cell.hook.pivot_o;
  const Eigen::Vector3d pivot_velocity_f =
      hook.twist_f.head<3>() + hook.twist_f.tail<3>().cross(arm_f);
  return pivot_velocity_f.dot(cell.belt.direction_f);
}

std::string whyNotOnBelt(const CellConfig& cell, const Pose& fMo, double tolerance_m) {
  const Eigen::Vector3d from_start = fMo * cell.hook.pivot_o - cell.belt.pivot_start_f;
  const Eigen::Vector3d off =
      from_start - from_start.dot(cell.belt.direction_f) * cell.belt.direction_f;
  if (off.norm() > tolerance_m) {
    return "pivot not on the belt's line";
  }
  const HangingPose hanging = hangingFromPose(fMo, cell.hook.pivot_o);
  const double limit = 1.5 * cell.hook.swing_max_rad + 0.02;
  if (std::abs(hanging.swing_x) > limit || std::abs(hanging.swing_y) > limit) {
    return "swing larger than the task allows";
  }
  constexpr double kTurnLimit = 0.2;  // [rad]; hooks hang by two hinges and cannot turn
  if (std::abs(hanging.yaw) > kTurnLimit) {
    return "hook turned about its shank";
  }
  return {};
}

bool comesIn(const CellConfig& cell, const Pose& fMo, double tolerance_m) {
  const double travel = hookTravel(cell, fMo);
  return travel >= cell.belt.search_from_m - tolerance_m &&
         travel <= cell.belt.search_to_m + tolerance_m;
}

std::vector<Pose> searchPoses(const CellConfig& cell) {
  std::vector<Pose> poses;
  const double swing = cell.hook.swing_max_rad;
  for (const double travel : {cell.belt.search_from_m, cell.belt.search_to_m}) {
    for (const double x : {-swing, swing}) {
      for (const double y : {-swing, swing}) {
        poses.push_back(hookOnBelt(cell, travel, x, y));
      }
    }
  }
  return poses;
}

}  // namespace ringhook
