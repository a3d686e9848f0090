#include "cycle/servo_loop.h"

#include "core/error.h"

namespace ringhook {
namespace {

void attempt(VisionSide& vision, Arm& arm, TaskControl& task, LoopObserver& observer,
             const std::atomic<bool>& stop) {
  vision.restart();
  task.startAttempt();
  bool watching = true;
  while (!task.finished()) {
    if (stop.load()) {
      throw Interrupted("stopped by the operator; the arm stands still");
    }
    const ArmState state = arm.waitState();
    if (!state.motion_possible) {
      throw DeviceError("the arm reports that no motion is possible");
    }
    const TaskCommand command = task.step(state, vision.newest(state));
    if (command.close_gripper) {
      arm.setGripper(*command.close_gripper);
    }
    arm.commandVelocity(command.velocity);
    observer.onCommand(state, command);
    if (watching && task.hookDone()) {
      watching = false;
      vision.restart();
    }
  }
}

}  // namespace

AttemptResult runAttempt(VisionSide& vision, Arm& arm, TaskControl& task, LoopObserver& observer,
                         const std::atomic<bool>& stop) {
  try {
    attempt(vision, arm, task, observer, stop);
  } catch (...) {
    arm.stop();
    throw;
  }
  return task.result();
}

}  // namespace ringhook
