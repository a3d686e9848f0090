#include "cycle/task_paths.h"

namespace ringhook {

constexpr double kApproachTime = 2.0;  // [s]; from standby to beside the hook, generously

InsertionParameters pathParameters(const CellConfig& cell) {
  InsertionParameters p;
  p.tip_o = cell.task.tip_o;
  p.hover_height = cell.task.hover_m;
  p.release_o = cell.task.release_o;
  p.retreat_o = cell.task.retreat_o;
  p.hold_s = cell.arm.gripper_time_s;
  p.approach.linear = cell.task.approach_speed_m_s;
  p.align.linear = cell.task.approach_speed_m_s;
  p.lower.linear = cell.task.path_speed_m_s;
  p.retreat.linear = cell.task.approach_speed_m_s;
  return p;
}

double insertionTime(const CellConfig& cell, const InsertionParameters& parameters) {
  const Pose standoff =
      makePose(parameters.tip_o + parameters.standoff_offset_o, Eigen::Quaterniond::Identity());
  double time = cell.task.align_dwell_s + cell.arm.gripper_time_s + kApproachTime;
  for (const InsertionPhase phase : {InsertionPhase::kAlign, InsertionPhase::kLower}) {
    time += pathDuration(planPhase(phase, standoff, parameters));
  }
  return time;
}

}  // namespace ringhook
