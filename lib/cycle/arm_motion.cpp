#include "cycle/arm_motion.h"

#include "robot/rx60/kinematics.h"
#include "servo/resolved_rate.h"

namespace ringhook {
namespace {

constexpr double kArrived = 1e-3;        // [rad]
constexpr double kCoarseGainPerS = 5.0;  // of the joint-space tracking law

}  // namespace

rx60::Geometry armOf(const StereoRig& rig) {
  rx60::Geometry arm = rx60::rx60();
  arm.zero = rig.joint_zeros_rad;
  return arm;
}

LimiterSettings limiterSettings(const ArmConfig& config, const rx60::Geometry& arm) {
  LimiterSettings settings;
  settings.geometry = arm;
  settings.tool_e = config.eMr.translation();
  settings.period_s = kArmPeriod;
  return settings;
}

ArmMotion::ArmMotion(const CellConfig& cell, const rx60::Geometry& arm)
    : eMr_(cell.arm.eMr),
      arm_(arm),
      limiter_(limiterSettings(cell.arm, arm)),
      speed_fraction_(cell.arm.speed_fraction),
      lead_s_(cell.arm.delay_s + 0.5 * kArmPeriod),
      servo_(ServoGains{cell.task.gain_per_s, cell.task.gain_per_s, 30.0}) {}

Pose ArmMotion::ringPose(const JointVector& position) const {
  return rx60::forward(arm_, position) * eMr_;
}

JointVector ArmMotion::rest(const ArmState& state) {
  move_.reset();
  return limiter_.limit(JointVector::Zero(), state.position).velocity;
}

Outcome<JointVector> ArmMotion::moveTo(const ArmState& state, const JointVector& target) {
  if (!move_ || move_->end != target) {
    const Outcome<JointMove> planned =
        planJointMove(state.position, target, limiter_.reach(), speed_fraction_);
    if (!planned) {
      return Refusal{planned.reason()};
    }
    move_ = *planned;
    move_start_ = state.time;
  }
  const JointVector wanted =
      trackJointMove(*move_, state.time - move_start_ + lead_s_, state.position, kCoarseGainPerS);
  return limiter_.limit(wanted, state.position).velocity;
}

bool ArmMotion::arrived(const ArmState& state) const {
  return move_ && state.time - move_start_ >= move_->duration_s &&
         (state.position - move_->end).cwiseAbs().maxCoeff() < kArrived;
}

Outcome<FollowCommand> ArmMotion::follow(const ArmState& state, const HookFilterState& hook,
                                         const RingGoal& goal) {
  move_.reset();
  const Outcome<HookEstimate> then = predictHook(hook, state.time + lead_s_);
  if (!then) {
    return Refusal{then.reason()};
  }
  const JointVector position = state.position + lead_s_ * limiter_.velocity();
  const Pose fMe = rx60::forward(arm_, position);
  const Outcome<ServoCommand> wanted = servo_.command(fMe * eMr_, *then, goal);
  if (!wanted) {
    return Refusal{wanted.reason()};
  }
  const ResolvedRate resolved =
      resolve(flangeTwist(fMe, eMr_, wanted->twist_r), rx60::jacobian(arm_, position));
  const LimitedVelocity out = limiter_.limit(resolved.velocity, state.position);
  return FollowCommand{out.velocity, wanted->error, out.limited()};
}

}  // namespace ringhook
