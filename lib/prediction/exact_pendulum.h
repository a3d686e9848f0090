#pragma once

/// \file
/// The linearised damped pendulum, discretised exactly: what the 2007 report's map (pendulum.h)
/// tends to when its step vanishes, for any step. Law, with k = g/L and damping c:
///   phi'' = -k phi - c phi'
/// With d = c/2, n = k - d^2 and (C, S) = (cos wt, sin wt / w) for n = w^2 > 0, (1, t) for n = 0,
/// (cosh wt, sinh wt / w) for n = -w^2 < 0 (under-damped, critical, over-damped), the exponential
/// of F = [0 1; -k -c] is
///   exp(F t) = e^(-d t) [C + d S, S; -k S, C - d S].
/// (Any text on linear oscillators; Meirovitch, "Fundamentals of Vibrations", 2001, section 2.2.)
///
/// Below a pivot that travels, the offset s from the pivot is pulled back and left behind:
///   s'' = -k s - c s' - a,   p' = v,   v' = a
/// and while the pivot's acceleration a is constant, s swings about -a/k, again in closed form. The
/// noise is Van Loan's (van_loan.h): white jerk of the pivot, or white acceleration of it where a
/// is no state, and white acceleration of the swing for all that the law leaves out.

#include <Eigen/Core>

namespace ringhook {

using Matrix5 = Eigen::Matrix<double, 5, 5>;

struct PendulumRates {
  double stiffness = 9.81;  ///< k = g/L [1/s^2], > 0
  double damping = 0.0;     ///< c [1/s], >= 0; D/m of the report's equation 5.18
};

/// Of a pendulum of effective length `length_m`, under `gravity` [m/s^2].
PendulumRates pendulumRates(double length_m, double damping_per_s, double gravity);

/// exp(F t) on (phi, phi') or (s, s') over `dt` >= 0 [s].
Eigen::Matrix2d exactPendulumTransition(const PendulumRates& rates, double dt);

/// The same on (p, v, s, s'): a pivot of constant velocity.
Eigen::Matrix4d exactDriftingTransition(const PendulumRates& rates, double dt);

/// The same on (p, v, a, s, s'): a pivot of constant acceleration.
Matrix5 exactTravellingTransition(const PendulumRates& rates, double dt);

/// F of the three, as in x' = F x.
Eigen::Matrix2d pendulumDrift(const PendulumRates& rates);
Eigen::Matrix4d driftingDrift(const PendulumRates& rates);
Matrix5 travellingDrift(const PendulumRates& rates);

/// W of the three. `swing_density`: white acceleration of the swing [rad^2/s^3, m^2/s^3];
/// `pivot_density`: white acceleration of the drifting pivot [m^2/s^3], which pushes the offset the
/// other way, or white jerk of the travelling one [m^2/s^5].
Eigen::Matrix2d pendulumDensity(double swing_density);
Eigen::Matrix4d driftingDensity(double pivot_density, double swing_density);
Matrix5 travellingDensity(double pivot_density, double swing_density);

}  // namespace ringhook
