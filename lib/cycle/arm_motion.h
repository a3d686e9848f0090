#pragma once

/// \file
/// Joint velocities for the three things the arm does: come to rest, move in joint space, follow a
/// goal on the moving hook. Every velocity passes the one limiter of robot/limiter.h; nothing else
/// of the cycle makes one. Timing: a command answers the state of instant t and acts from t + delay
/// for one period, so hook and ring are both predicted to the middle of that period.

#include <optional>

#include "core/hook_values.h"
#include "core/joints.h"
#include "core/outcome.h"
#include "cycle/cell_config.h"
#include "prediction/hook_filter.h"
#include "rig/stereo_rig.h"
#include "robot/limiter.h"
#include "servo/joint_move.h"
#include "servo/pose_servo.h"

namespace ringhook {

/// The arm that a rig's fMc1 belongs to: its joint zeros are those of the rig.
rx60::Geometry armOf(const StereoRig& rig);

/// Limits of a held ring: its centre is the tool point.
LimiterSettings limiterSettings(const ArmConfig& config, const rx60::Geometry& arm);

/// State messages of the arm are this far apart [s] (rx60.md: 250 Hz).
inline constexpr double kArmPeriod = 0.004;

struct FollowCommand {
  JointVector velocity;  ///< [rad/s]
  ServoError error;      ///< ring against goal, both predicted to when the command acts
  bool limited = false;  ///< a limit bent the command
};

class ArmMotion {
 public:
  /// \param arm as calibrated. Throws InputError for gains out of range.
  ArmMotion(const CellConfig& cell, const rx60::Geometry& arm);

  /// Ring in f by the arm's kinematics.
  [[nodiscard]] Pose ringPose(const JointVector& position) const;

  /// Slows down to rest as fast as the limits allow.
  JointVector rest(const ArmState& state);

  /// Moves towards `target` [rad] from rest to rest; plans anew when the target changes. Refuses
  /// targets outside the limiter's reach.
  Outcome<JointVector> moveTo(const ArmState& state, const JointVector& target);
  /// True once the last moveTo() target is reached within a milliradian per joint.
  [[nodiscard]] bool arrived(const ArmState& state) const;

  /// Follows `goal` on the hook. Refuses when the hook cannot be predicted that far.
  Outcome<FollowCommand> follow(const ArmState& state, const HookFilterState& hook,
                                const RingGoal& goal);

 private:
  Pose eMr_;
  rx60::Geometry arm_;
  Limiter limiter_;
  double speed_fraction_;
  double lead_s_;  ///< from a state to the middle of the period in which its command acts
  PoseServo servo_;
  std::optional<JointMove> move_;
  Time move_start_;
};

}  // namespace ringhook
