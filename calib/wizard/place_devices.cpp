#include "calib/wizard/place_devices.h"

#include <utility>

#include "calib/wizard/place_way.h"
#include "core/error.h"
#include "robot/rx60/kinematics.h"

namespace ringhook {
namespace {

constexpr double kPictureRate = 5.0;       // [Hz]
constexpr double kPicturePatience = 20.0;  // [s]
constexpr double kStampSlack = 0.05;       // a stamp may lie so far behind its exposure [s]
constexpr double kMovePatience = 60.0;     // [s]
constexpr double kSettle = 0.4;            // the controller's last micrometres [s]
constexpr double kAtRest = 1e-3;           // [rad/s]
constexpr double kRestPatience = 5.0;      // [s]
constexpr Window kNothing{0, 0, 16, 16};   // what is read while nobody looks

CellConfig withCommandDelay(CellConfig cell, const Arm& arm) {
  cell.arm.delay_s += arm.commandDelay();
  return cell;
}

ArmState stateOf(Arm& arm) {
  ArmState state = arm.waitState();
  if (!state.motion_possible) {
    throw DeviceError("the arm reports that no motion is possible");
  }
  return state;
}

}  // namespace

DevicePlace::DevicePlace(const CellConfig& cell, std::unique_ptr<Arm> arm,
                         std::unique_ptr<StereoCamera> camera, bool stamps_are_mid_exposure)
    : cell_(cell),
      arm_(std::move(arm)),
      camera_(std::move(camera)),
      devices_{*arm_, *camera_, stamps_are_mid_exposure, [] { return std::nullopt; }} {
  restCamera();
}

void DevicePlace::restCamera() {
  camera_->setWindows(kNothing, kNothing);
  camera_->setFrameRate(kPictureRate);
}

std::optional<StereoFrame> DevicePlace::takePair() {
  const Window full = camera_->fullImage();
  const Outcome<ArmState> rest = armState();
  if (!rest) {
    throw DeviceError(rest.reason());
  }
  camera_->setWindows(full, full);
  camera_->setFrameRate(kPictureRate);
  const Time asked = rest->time;
  std::optional<StereoFrame> frame;
  do {
    step();
    if (arm_->waitState().time - asked > kPicturePatience) {
      throw DeviceError("the cameras delivered no full pair of images within 20 s");
    }
    frame = camera_->grab(0.0);
  } while (!frame || frame->time - asked < kStampSlack || frame->left_window != full ||
           frame->right_window != full);
  restCamera();
  return frame;
}

Outcome<ArmState> DevicePlace::armState() {
  ArmState state = arm_->waitState();
  const Time asked = state.time;
  do {
    step();
    state = arm_->waitState();
    if (state.time - asked > kRestPatience) {
      return Refusal{"the arm does not come to rest"};
    }
  } while (state.velocity.cwiseAbs().maxCoeff() > kAtRest);
  return state;
}

Outcome<Pose> DevicePlace::moveJoints(const JointVector& target) {
  if (needsConfirmation()) {
    return Refusal{"nobody confirmed that the arm may move"};
  }
  const Outcome<ArmState> begin = armState();
  if (!begin) {
    return Refusal{begin.reason()};
  }
  if (const auto what = inTheWay(cell_, begin->position, target)) {
    return Refusal{*what};
  }
  ArmMotion motion(withCommandDelay(cell_, *arm_), rx60::rx60());
  if (const Outcome<JointVector> first = motion.moveTo(*begin, target); !first) {
    return Refusal{first.reason()};
  }
  try {
    const ArmState end = run(motion, target, *begin);
    return rx60::forward(rx60::rx60(), end.position);
  } catch (...) {
    arm_->stop();
    throw;
  }
}

/// Until the arm is there, and a little longer, for the law that corrects what is missing.
ArmState DevicePlace::run(ArmMotion& motion, const JointVector& target, ArmState state) {
  const Time begin = state.time;
  std::optional<Time> arrived;
  while (!arrived || state.time - *arrived < kSettle) {
    step();
    const Outcome<JointVector> velocity = motion.moveTo(state, target);
    if (!velocity) {
      throw DeviceError("the arm left its way: " + velocity.reason());
    }
    arm_->commandVelocity(*velocity);
    state = stateOf(*arm_);
    if (!arrived && motion.arrived(state)) {
      arrived = state.time;
    }
    if (state.time - begin > kMovePatience) {
      throw DeviceError("the arm did not arrive within 60 s");
    }
  }
  const Time settled = state.time;
  do {
    arm_->commandVelocity(motion.rest(state));
    state = stateOf(*arm_);
  } while (state.velocity.cwiseAbs().maxCoeff() > kAtRest && state.time - settled < kRestPatience);
  return state;
}

}  // namespace ringhook
