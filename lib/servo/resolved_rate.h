#pragma once

/// \file
/// Joint velocities for a wanted flange velocity. Not yet limited: the arm's limiter does that.
///
/// Law: damped least squares q' = J^T (J J^T + l^2 I)^-1 v with l = damping * (1 - w / w0) where
/// the manipulability w = |det J| falls below w0 (Nakamura and Hanafusa, "Inverse kinematic
/// solutions with singularity robustness", ASME JDSMC 1986), l = 0 elsewhere.

#include "core/joints.h"
#include "core/pose.h"

namespace ringhook {

struct ResolvedRateOptions {
  double damping = 0.05;                   ///< at the singularity, mixed units of J
  double manipulability_threshold = 2e-3;  ///< |det J| below which damping sets in [m^3]
};

struct ResolvedRate {
  JointVector velocity;         ///< wanted [rad/s]; not finite where twist or Jacobian are not
  double manipulability = 0.0;  ///< |det J| [m^3]
  bool damped = false;          ///< near a singularity
};

/// Twist of the flange at e expressed in f for a ring twist expressed in r at r; r stands at eMr
/// on the flange.
Twist flangeTwist(const Pose& fMe, const Pose& eMr, const Twist& twist_r);

/// Joint velocities for the flange twist `twist_f` (at e, expressed in f) with its Jacobian fJe.
ResolvedRate resolve(const Twist& twist_f, const Jacobian& fJe,
                     const ResolvedRateOptions& options = {});

}  // namespace ringhook
