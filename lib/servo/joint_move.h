#pragma once

/// \file
/// A coarse move in joint space from rest to rest, all joints starting and stopping together.
/// Law: minimum-jerk quintic q = q0 + (q1 - q0)(10 u^3 - 15 u^4 + 6 u^5), u = t / T; T is the
/// least for which every joint keeps its speed (peak 15/8 D/T) and acceleration (peak
/// 10/sqrt(3) D/T^2). The tracking law sends the path's velocity plus gain times what is missing.

#include "core/joints.h"
#include "core/outcome.h"

namespace ringhook {

struct JointMove {
  JointVector start;        ///< [rad]
  JointVector end;          ///< [rad]
  double duration_s = 0.0;  ///< 0 if both are the same
};

struct JointSample {
  JointVector position;  ///< [rad]
  JointVector velocity;  ///< [rad/s]
};

/// Plans with `fraction` (0 to 1] of the speed and acceleration limits. Refuses ends that leave
/// the position limits (a start outside is accepted: the move leads back), values that are not
/// finite, and other fractions.
Outcome<JointMove> planJointMove(const JointVector& start, const JointVector& end,
                                 const JointLimits& limits, double fraction);

/// Where the move wants the joints `t` seconds after its start; at rest before and after it.
JointSample sampleJointMove(const JointMove& move, double t);

/// Velocity command [rad/s] that follows the move: feed-forward plus gain_per_s [1/s] times the
/// distance from q to the path. Not yet limited: the arm's limiter does that.
JointVector trackJointMove(const JointMove& move, double t, const JointVector& q,
                           double gain_per_s);

}  // namespace ringhook
