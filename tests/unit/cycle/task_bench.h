#pragma once

/// \file
/// The task with an arm that does exactly what it is told, and with the estimate of a filter that
/// gets exact fixes of a hook known in closed form. Everything is deterministic.

#include <optional>
#include <string>
#include <vector>

#include "cycle/task_control.h"
#include "moving_hook.h"

namespace ringhook::test {

/// What vision hands to the task.
enum class Sight {
  kFresh,   ///< the filter's newest estimate
  kFrozen,  ///< the last one for ever: no further fixes
  kNothing  ///< no hook is tracked
};

/// A gripper order and where the ring truly was.
struct GripperOrder {
  bool close = false;
  TaskPhase phase = TaskPhase::kDone;
  Pose oMr = Pose::Identity();  ///< ring on the true hook
};

class TaskBench {
 public:
  TaskBench(const CellConfig& cell, const MovingHook& hook);

  /// One arm period: state, command, motion.
  void step(Sight sight = Sight::kFresh);
  /// Steps until `phase` is reached; false if that takes longer than a minute or the task ends.
  bool runTo(TaskPhase phase, Sight sight = Sight::kFresh);
  /// Steps until the task is finished; false after a minute.
  bool finish(Sight sight = Sight::kFresh);

  [[nodiscard]] Pose ring_o() const;
  [[nodiscard]] double seconds() const { return state_.time.seconds(); }

  CellConfig cell;
  MovingHook hook;
  TaskControl task;
  std::vector<GripperOrder> orders;
  std::vector<TaskPhase> phases;  ///< in the order entered
  int commands = 0;
  int refused_fixes = 0;                   ///< by the filter
  std::vector<std::string> broken_limits;  ///< one line for each command that broke one
  double worst_hold_m = 0.0;  ///< true ring against the place of release, from release to retreat

 private:
  void observe(Sight sight);
  void check(const JointVector& velocity);
  void note(const TaskCommand& command);

  Pose fMc1_;
  HookFilter filter_;
  std::optional<HookFilterState> estimate_;
  ArmState state_;
  long step_count_ = 0;
};

}  // namespace ringhook::test
