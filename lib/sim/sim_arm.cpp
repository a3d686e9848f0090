#include "sim/sim_arm.h"

#include <algorithm>
#include <deque>
#include <string>

#include "core/error.h"
#include "robot/rx60/kinematics.h"

namespace ringhook {
namespace {

std::string jointName(int index) { return std::string("J").append(std::to_string(index + 1)); }

}  // namespace

/// Encoder readings of the last moments, one for each physics step.
class SimArm::Past {
 public:
  explicit Past(double delay_s) : delay_s_(delay_s) {}

  void note(Time time, const JointVector& reading) {
    while (readings_.size() > 2 && time - readings_[1].time >= delay_s_) {
      readings_.pop_front();
    }
    readings_.push_back({time, reading});
  }

  /// What the encoders said the delay before `now`: between two steps joints move evenly.
  [[nodiscard]] JointVector before(Time now) const {
    const Time then = now - delay_s_;
    std::size_t next = 1;
    while (next + 1 < readings_.size() && readings_[next].time < then) {
      ++next;
    }
    const Reading& a = readings_[next - 1];
    const Reading& b = readings_[next];
    const double share = std::clamp((then - a.time) / (b.time - a.time), 0.0, 1.0);
    return a.position + share * (b.position - a.position);
  }

 private:
  struct Reading {
    Time time;
    JointVector position;  // [rad]
  };
  double delay_s_;
  std::deque<Reading> readings_;
};

SimArm::SimArm(CellWorld& world, double state_delay_s)
    : world_(world), last_position_(world.jointReading()) {
  if (!(state_delay_s > 0.0)) {
    return;
  }
  past_ = std::make_shared<Past>(state_delay_s);
  past_->note(world.time(), last_position_);
  // The world keeps its callbacks for ever; this one ends with the arm.
  world.every(world.options().physics_step, 0.0, [weak = std::weak_ptr(past_), &world](Time time) {
    if (const auto past = weak.lock()) {
      past->note(time, world.jointReading());
    }
  });
}

SimArm::~SimArm() = default;

ArmState SimArm::waitState() {
  world_.advanceTo(world_.time() + kPeriod);
  ArmState state;
  state.time = world_.time();
  state.position = past_ ? past_->before(state.time) : world_.jointReading();
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
