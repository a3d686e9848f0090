#pragma once

/// \file
/// The law of a compound pendulum on a universal joint below an accelerated pivot.
/// With u = (-sin b, sin a cos b, -cos a cos b) the shank's direction, a about x, b about y, and
/// the pivot's acceleration A, the hook feels the gravity G = -(A + (0, 0, g)). Lagrange's
/// equations (Goldstein, "Classical Mechanics", section 1.4) for a body that is slender about its
/// shank, with effective lengths L = I / (m d) about either axis, are
///   a'' = 2 tan(b) a' b' + (-A_y cos a - (g + A_z) sin a) / (L_x cos b) - D(a')
///   b'' = -(L_x / L_y) sin b cos b a'^2
///         + (A_x cos b + A_y sin a sin b - (g + A_z) cos a sin b) / L_y - D(b')
///   D(w) = c w + k tanh(w / w0):  viscous and dry (Coulomb) friction; w0 rounds the sign's corner.
/// One plane alone is the pendulum phi'' = -(g/L) sin(phi) of the 2007 report's equation 5.12, kept
/// nonlinear. The pivot follows Singer's law (IEEE Trans. AES-6, 1970): its acceleration forgets
/// itself over the memory time and is fed by white noise, p' = v, v' = A, A' = -A / memory + e.

#include <Eigen/Core>

#include "prediction/swing_state.h"

namespace ringhook {

struct SwingLaw {
  double gravity = 9.81;     ///< g [m/s^2]
  double memory_s = 0.3;     ///< of the pivot's acceleration
  double dry_corner = 0.02;  ///< w0: rate at which dry friction is three quarters there [rad/s]
};

using SwingSlope = Eigen::Matrix<double, kSwingMoving, 1>;
using SwingSlopeJacobian = Eigen::Matrix<double, kSwingMoving, kSwingStates>;

/// Time derivative of the moving part of the state. Precondition: |swing_y| < 90 degrees.
SwingSlope swingSlope(const SwingVector& state, const SwingLaw& law);

/// d swingSlope / d state.
SwingSlopeJacobian swingSlopeJacobian(const SwingVector& state, const SwingLaw& law);

}  // namespace ringhook
