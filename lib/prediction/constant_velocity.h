#pragma once

/// \file
/// One coordinate that moves with nearly constant velocity: the plainest model, below the 2007
/// report's own (constant_acceleration.h). State (p, v). Law: p' = p + v dt, v' = v, pushed by
/// white acceleration of density q (Bar-Shalom, Li, Kirubarajan, "Estimation with Applications to
/// Tracking and Navigation", 2001, section 6.2.2).

#include <Eigen/Core>

namespace ringhook {

/// Transition over `dt` [s].
Eigen::Matrix2d velocityTransition(double dt);

/// Noise that white acceleration of density `density` [m^2/s^3, or rad^2/s^3] leaves after
/// `dt` >= 0 [s]: q [dt^3/3 dt^2/2; dt^2/2 dt].
Eigen::Matrix2d whiteAccelerationNoise(double dt, double density);

}  // namespace ringhook
