#include "sim/sim_arm.h"

#include <string>

#include "core/error.h"
#include "robot/rx60/kinematics.h"

namespace ringhook {
namespace {

std::string jointName(int index) { return std::string("J").append(std::to_string(index + 1)); }

}  // namespace

SimArm::SimArm(CellWorld& world) : world_(world), last_position_(world.jointReading()) {}

ArmState SimArm::waitState() {
  world_.advanceTo(world_.time() + kPeriod);
  ArmState state;
  state.time = world_.time();
  state.position = world_.jointReading();
  state.velocity = (state.position - last_position_) / kPeriod;
  state.motion_possible = !stopped_;
  last_position_ = state.position;
  return state;
}

void SimArm::commandVelocity(const JointVector& joint_velocity) {
  if (stopped_) {
    throw DeviceError("The arm is stopped and accepts no motion until it is rearmed.");
  }
  if (!joint_velocity.allFinite()) {
    refuse("a joint velocity is not a finite number");
  }
  static const JointLimits limits = rx60::limits();
  const JointVector reached = world_.jointReading() + kPeriod * joint_velocity;
  for (int i = 0; i < 6; ++i) {
    if (std::abs(joint_velocity[i]) > limits.velocity[i]) {
      refuse(jointName(i) + " was commanded " + std::to_string(joint_velocity[i]) +
             " rad/s, its limit is " + std::to_string(limits.velocity[i]) + " rad/s");
    }
    if (reached[i] < limits.lower[i] || reached[i] > limits.upper[i]) {
      refuse(jointName(i) + " would leave its range at " + std::to_string(reached[i]) + " rad");
    }
  }
  world_.setJointVelocity(joint_velocity, kPeriod);
}

void SimArm::stop() noexcept {
  stopped_ = true;
  world_.setJointVelocity(JointVector::Zero(), kPeriod);
}

void SimArm::rearm() { stopped_ = false; }

void SimArm::setGripper(bool closed) { world_.setGripper(closed); }

void SimArm::refuse(const std::string& why) {
  stop();
  throw DeviceError("The arm refused a command and stopped: " + why + ".");
}

}  // namespace ringhook
