#pragma once

/// \file
/// One period of a joint that changes its speed with bounded acceleration and jerk.
///
/// Law, in periods of T: v' = v + a' T with |a'| <= A and |a' - a| <= d, d = J T. An acceleration
/// a' >= 0 that is led back to zero as fast as d allows adds up to g(a') = a' + (a' - d)+ +
/// (a' - 2d)+ + ... (times T): piecewise linear, g(n d) = d n (n + 1) / 2, slope n + 1 from n d to
/// (n + 1) d. A target speed u is reached without being passed as long as g(a') <= (u - v) / T; the
/// greatest such a' is the inverse of g, in closed form. That is the time-optimal bang-bang law for
/// a double integrator (Athans and Falb, "Optimal Control", 1966, ch. 7) on whole periods.
///
/// From a state in which the speed limit can still be kept, every step can keep it: the bound
/// g(a') <= (vmax - v) / T then never asks for more than the jerk allows.

namespace ringhook {

/// What bounds one joint; all positive.
struct JointBounds {
  double velocity;      ///< [rad/s]
  double acceleration;  ///< A [rad/s^2]
  double jerk_step;     ///< d, what the jerk lets the acceleration change by in a period [rad/s^2]
  double period_s;      ///< T
};

/// Acceleration a >= 0 (or its mirror image) from which the sum over the way back to zero in steps
/// of `step` is `sum`; both [rad/s^2], step > 0.
double accelerationOfSum(double sum, double step);

/// The speed and the acceleration that led to it.
struct JointRate {
  double velocity = 0.0;      ///< [rad/s]
  double acceleration = 0.0;  ///< [rad/s^2]
};

/// Next rate on the way to `target` [rad/s], |target| <= bounds.velocity, which itself changes by
/// `target_acceleration` [rad/s^2] (0: a constant target is never passed).
JointRate stepTowards(const JointRate& rate, double target, double target_acceleration,
                      const JointBounds& bounds);

/// stepTowards() to a standstill, for rates that keep the speed limit.
JointRate brakingStep(const JointRate& rate, const JointBounds& bounds);

}  // namespace ringhook
