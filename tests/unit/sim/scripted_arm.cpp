#include "scripted_arm.h"

#include "core/error.h"
#include "robot/rx60/kinematics.h"
#include "sim/cell_model.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

double smooth(double s) { return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s); }

/// Where the hook will be one period later.
Pose hookAhead(const HookTruth& hook, double dt) {
  Pose ahead = hook.fMo;
  ahead.translation() += dt * hook.twist_f.head<3>();
  const Eigen::Vector3d turn = dt * hook.twist_f.tail<3>();
  if (turn.norm() > 0.0) {
    ahead.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * hook.fMo.linear();
  }
  return ahead;
}

}  // namespace

JointVector jointsForRing(const CellOptions& options, const Pose& fMr,
                          const JointVector& reference) {
  const auto q = rx60::nearestInverse(rx60::rx60(), rx60::limits(),
                                      fMr * gripPose(options).inverse(), reference);
  if (!q) {
    throw Error("Scripted arm: " + q.reason());
  }
  return *q;
}

Pose ringFromJoints(const CellOptions& options, const JointVector& q) {
  return rx60::forward(rx60::rx60(), q) * gripPose(options);
}

CellOptions standingCell(const Pose& oMr) {
  CellOptions options;
  options.hook.count = 1;
  options.hook.swing_about_x = options.hook.swing_about_y = 0.0;
  options.hook.length_spread = 0.0;
  options.belt.speed = options.belt.start_y = options.belt.entry_y = 0.0;
  options.arm.zero_error_sigma = 0.0;
  options.gripper.feeder_clearance = 0.0;
  const CellWorld probe(options);
  options.arm.initial_joints =
      jointsForRing(options, truth(probe).hooks[0].fMo * oMr, options.arm.initial_joints);
  return options;
}

Pose shifted(double x, double y, double z) { return Pose(Eigen::Translation3d(x, y, z)); }

void ScriptedArm::moveTo(const Pose& oMr, double duration, const std::function<void()>& watch) {
  const CellOptions& options = world_.options();
  const Pose start =
      truth(world_).hooks[hook_].fMo.inverse() * ringFromJoints(options, world_.jointReading());
  const int ticks = static_cast<int>(duration / SimArm::kPeriod);
  const JointVector fastest = 0.95 * rx60::limits().velocity;
  for (int i = 0; i < ticks; ++i) {
    const Pose ahead = hookAhead(truth(world_).hooks[hook_], SimArm::kPeriod);
    const Pose fMr = ahead * interpolate(start, oMr, smooth((i + 1.0) / ticks));
    const JointVector q = world_.jointReading();
    const JointVector velocity = (jointsForRing(options, fMr, q) - q) / SimArm::kPeriod;
    arm_.commandVelocity(velocity.cwiseMax(-fastest).cwiseMin(fastest));
    static_cast<void>(arm_.waitState());
    if (watch) {
      watch();
    }
  }
}

void ScriptedArm::rest(double duration, const std::function<void()>& watch) {
  for (int i = 0; i < static_cast<int>(duration / SimArm::kPeriod); ++i) {
    static_cast<void>(arm_.waitState());
    if (watch) {
      watch();
    }
  }
}

void insertRing(ScriptedArm& arm, const std::function<void()>& watch) {
  arm.moveTo(shifted(-0.12, 0.035, 0.060), 2.0, watch);
  arm.moveTo(shifted(0.0, 0.035, 0.060), 1.0, watch);
  arm.moveTo(shifted(0.0, 0.035, 0.007), 1.0, watch);
  arm.arm().setGripper(false);
  arm.moveTo(shifted(0.0, 0.035, 0.007), 0.2, watch);
  arm.moveTo(shifted(-0.12, 0.035, 0.007), 0.8, watch);
}

}  // namespace ringhook
