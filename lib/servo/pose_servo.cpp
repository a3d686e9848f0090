#include "servo/pose_servo.h"

#include <cmath>
#include <string>

#include "core/error.h"

namespace ringhook {
namespace {

double positiveGain(double value, const char* name) {
  if (!(std::isfinite(value) && value > 0.0)) {
    throw InputError(std::string("servo gain ") + name + " must be positive and finite");
  }
  return value;
}

bool finite(const Pose& fMr, const HookEstimate& hook, const RingGoal& goal) {
  return fMr.matrix().allFinite() && hook.fMo.matrix().allFinite() && hook.twist_f.allFinite() &&
         goal.oMr.matrix().allFinite() && goal.twist_o.allFinite();
}

/// The same twist, at the same point, expressed in axes turned by aRb.
Twist rotated(const Eigen::Matrix3d& aRb, const Twist& twist_b) {
  Twist twist_a;
  twist_a << aRb * twist_b.head<3>(), aRb * twist_b.tail<3>();
  return twist_a;
}

}  // namespace

PoseServo::PoseServo(const ServoGains& gains)
    : law_(positiveGain(gains.at_zero, "at_zero"), positiveGain(gains.at_infinity, "at_infinity"),
           positiveGain(gains.slope_at_zero, "slope_at_zero")) {}

Twist goalTwist(const HookEstimate& hook, const RingGoal& goal) {
  const Twist hook_twist_o = rotated(hook.fMo.linear().transpose(), hook.twist_f);
  const Twist path_twist_d = rotated(goal.oMr.linear().transpose(), goal.twist_o);
  return twistTransform(goal.oMr.inverse()) * hook_twist_o + path_twist_d;
}

Outcome<ServoCommand> PoseServo::command(const Pose& fMr, const HookEstimate& hook,
                                         const RingGoal& goal) {
  if (!finite(fMr, hook, goal)) {
    return Refusal{"ring pose, hook estimate or goal is not finite"};
  }
  const Pose dMr = (hook.fMo * goal.oMr).inverse() * fMr;
  const VispLaw::Feedback feedback = law_.feedback(dMr);
  ServoCommand command;
  command.error = {dMr.translation().norm(), thetaU(dMr.linear()).norm()};
  command.feed_forward_r = twistTransform(dMr.inverse()) * goalTwist(hook, goal);
  command.twist_r = feedback.twist_r + command.feed_forward_r;
  command.gain_per_s = feedback.gain_per_s;
  return command;
}

}  // namespace ringhook
