#pragma once

/// \file
/// What the loop can tell about itself, without any truth: counted from what it sees and commands.

#include "core/joints.h"
#include "cycle/statistics.h"
#include "cycle/task_control.h"
#include "cycle/vision_step.h"

namespace ringhook {

struct LoopStatistics {
  Statistics prediction_error_m;  ///< fixes against predictions made 100 ms before, at o
  Statistics frame_age_s;         ///< from mid-exposure to the arm state that was answered with it
  Statistics nis;                 ///< of the fixes taken; chi-square of 6 if consistent
  Statistics fix_error_m;      ///< fixes against the true hook (physics), at o [m]; simulated only
  int frames = 0;              ///< taken while a hook was tracked
  int frames_without_fix = 0;  ///< of these
  int limited_commands = 0;    ///< bent by a limit
  int limit_violations = 0;    ///< arm states outside joint range or nominal speed

  void merge(const LoopStatistics& other);
};

/// Counts one frame. `age_s`: from mid-exposure to the arm state being answered [s].
void countFrame(const VisionReport& report, double age_s, LoopStatistics& statistics);

/// Counts one command and the state that it answers. \param limits joint ranges and speeds that no
/// state may break.
void countCommand(const ArmState& state, const TaskCommand& command, const JointLimits& limits,
                  LoopStatistics& statistics);

}  // namespace ringhook
