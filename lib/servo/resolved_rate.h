#pragma once

/// \file
/// Joint velocities for a wanted flange velocity, and the last gate before the arm: what leaves
/// here is finite and keeps speed, acceleration and position limits, whatever comes in.
///
/// Law: damped least squares q' = J^T (J J^T + l^2 I)^-1 v with l = damping * (1 - w / w0) where
/// the manipulability w = |det J| falls below w0 (Nakamura and Hanafusa, "Inverse kinematic
/// solutions with singularity robustness", ASME JDSMC 1986), l = 0 elsewhere.
///
/// A joint at distance d from its limit may go no faster than the speed from which it can still
/// stop: v <= sqrt(2 a d) - a T / 2, the continuous sqrt(2 a d) less what the sampling period T
/// costs; a joint that obeys it once can always obey it again without breaking acceleration.
///
/// Speed and position limits shorten the whole vector, so that the ring slows down on its line
/// instead of leaving it; the acceleration limit goes a part of the straight way from the previous
/// velocity to the wanted one.

#include "core/joints.h"
#include "core/pose.h"

namespace ringhook {

struct ResolvedRateOptions {
  double damping = 0.05;                   ///< at the singularity, mixed units of J
  double manipulability_threshold = 2e-3;  ///< |det J| below which damping sets in [m^3]
};

/// Velocities and what bent them.
struct JointVelocityOutcome {
  JointVector velocity = JointVector::Zero();  ///< [rad/s]
  double manipulability = 0.0;                 ///< |det J| [m^3]; 0 if no Jacobian was used
  bool damped = false;                         ///< near a singularity
  bool speed_limited = false;
  bool position_limited = false;  ///< slowed down ahead of a joint limit
  bool acceleration_limited = false;
  /// Something was not finite, or a limit not positive: the arm is slowed down to rest as fast as
  /// the limits allow, at once where limits or previous velocity mean nothing.
  bool bad_input = false;

  [[nodiscard]] bool limited() const {
    return speed_limited || position_limited || acceleration_limited || bad_input;
  }
};

/// Twist of the flange at e expressed in f for a ring twist expressed in r at r; r stands at eMr
/// on the flange.
Twist flangeTwist(const Pose& fMe, const Pose& eMr, const Twist& twist_r);

/// Joint velocities for the flange twist `twist_f` (at e, expressed in f) with its Jacobian fJe.
/// \param q where the joints are [rad]
/// \param previous_velocity the command before [rad/s]
/// \param period_s how long this command acts [s]
/// Limits are promised for a previous velocity that kept them; otherwise speed and position come
/// before acceleration.
JointVelocityOutcome resolve(const Twist& twist_f, const Jacobian& fJe, const JointVector& q,
                             const JointVector& previous_velocity, const JointLimits& limits,
                             double period_s, const ResolvedRateOptions& options = {});

/// The gate alone, for velocities wanted in joint space.
JointVelocityOutcome limitVelocity(const JointVector& wanted, const JointVector& q,
                                   const JointVector& previous_velocity, const JointLimits& limits,
                                   double period_s);

}  // namespace ringhook
