#include "cycle/servo_loop.h"

#include "core/error.h"

namespace ringhook {
namespace {

/// Vision's side of one turn: every frame that has arrived, oldest first.
void takeFrames(StereoCamera& camera, VisionStep& vision, const ArmState& state,
                LoopObserver& observer) {
  while (const std::optional<StereoFrame> frame = camera.grab(0.0)) {
    const VisionReport report = vision.process(*frame);
    camera.setWindows(vision.windows()[0], vision.windows()[1]);
    camera.setFrameRate(vision.rateHz());
    observer.onFrame(*frame, report, state.time - frame->time);
  }
}

void attempt(StereoCamera& camera, Arm& arm, VisionStep& vision, TaskControl& task,
             LoopObserver& observer, const std::atomic<bool>& stop) {
  vision.restart();
  camera.setWindows(vision.windows()[0], vision.windows()[1]);
  camera.setFrameRate(vision.rateHz());
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
    takeFrames(camera, vision, state, observer);
    const TaskCommand command = task.step(state, vision.estimate());
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

AttemptResult runAttempt(StereoCamera& camera, Arm& arm, VisionStep& vision, TaskControl& task,
                         LoopObserver& observer, const std::atomic<bool>& stop) {
  try {
    attempt(camera, arm, vision, task, observer, stop);
  } catch (...) {
    arm.stop();
    throw;
  }
  return task.result();
}

}  // namespace ringhook
