#include "sim/rx60_plant.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "robot/rx60/kinematics.h"

namespace ringhook {

KinematicPlant::KinematicPlant(JointVector position) : position_(std::move(position)) {}

void KinematicPlant::advanceTo(Time time) {
  if (time <= time_) {
    return;
  }
  static const JointLimits limits = rx60::limits();
  const double moving_s = std::max(0.0, std::min(time, velocity_end_) - time_);
  position_ = (position_ + moving_s * velocity_).cwiseMax(limits.lower).cwiseMin(limits.upper);
  time_ = time;
}

void KinematicPlant::setVelocity(const JointVector& joint_velocity, double duration_s) {
  assert(joint_velocity.allFinite());
  velocity_ = joint_velocity;
  velocity_end_ = time_ + duration_s;
}

bool KinematicPlant::output(int module, int pin) const {
  const auto found = outputs_.find({module, pin});
  return found != outputs_.end() && found->second;
}

CellPlant::CellPlant(CellWorld& world, const GripperOutput& gripper)
    : world_(world), gripper_(gripper) {}

void CellPlant::advanceTo(Time time) { world_.advanceTo(time); }

JointVector CellPlant::position() const { return world_.jointReading(); }

void CellPlant::setVelocity(const JointVector& joint_velocity, double duration_s) {
  world_.setJointVelocity(joint_velocity, duration_s);
}

void CellPlant::setOutput(int module, int pin, bool state) {
  if (module == gripper_.module && pin == gripper_.pin) {
    world_.setGripper(state);
  }
}

}  // namespace ringhook
