#include "servo/resolved_rate.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace ringhook {
namespace {

/// Speeds allowed to one joint for the coming period [rad/s]; lower <= 0 <= upper.
struct Box {
  JointVector lower;
  JointVector upper;
};

/// Greatest speed towards a limit `distance` [rad] away from which the joint still stops in time.
double brakingSpeed(double distance, double acceleration, double period_s) {
  if (!(distance > 0.0)) {
    return 0.0;
  }
  return std::max(0.0, std::sqrt(2.0 * acceleration * distance) - 0.5 * acceleration * period_s);
}

/// Speeds from which every joint still stops ahead of its position limits.
Box positionBox(const JointVector& q, const JointLimits& limits, double period_s) {
  Box box;
  for (int i = 0; i < 6; ++i) {
    box.upper(i) = brakingSpeed(limits.upper(i) - q(i), limits.acceleration(i), period_s);
    box.lower(i) = -brakingSpeed(q(i) - limits.lower(i), limits.acceleration(i), period_s);
  }
  return box;
}

/// Greatest factor up to 1 that brings the whole of v into the box.
double scaleInto(const Box& box, const JointVector& v) {
  double scale = 1.0;
  for (int i = 0; i < 6; ++i) {
    const double bound = v(i) > 0.0 ? box.upper(i) : box.lower(i);
    if (std::abs(v(i)) > std::abs(bound)) {
      scale = std::min(scale, bound / v(i));
    }
  }
  return scale;
}

/// Greatest part up to 1 of the step that keeps every joint's speed change within `allowed`.
double stepWithin(const JointVector& step, const JointVector& allowed) {
  double part = 1.0;
  for (int i = 0; i < 6; ++i) {
    if (std::abs(step(i)) > allowed(i)) {
      part = std::min(part, allowed(i) / std::abs(step(i)));
    }
  }
  return part;
}

bool positive(const JointVector& v) { return v.allFinite() && (v.array() > 0.0).all(); }

/// With limits or a period that mean nothing no velocity is safe but zero.
bool limitsUsable(const JointLimits& limits, double period_s) {
  return positive(limits.velocity) && positive(limits.acceleration) && limits.lower.allFinite() &&
         limits.upper.allFinite() && std::isfinite(period_s) && period_s > 0.0;
}

}  // namespace

Twist flangeTwist(const Pose& fMe, const Pose& eMr, const Twist& twist_r) {
  const Twist twist_e = twistTransform(eMr) * twist_r;
  Twist twist_f;
  twist_f << fMe.linear() * twist_e.head<3>(), fMe.linear() * twist_e.tail<3>();
  return twist_f;
}

JointVelocityOutcome limitVelocity(const JointVector& wanted, const JointVector& q,
                                   const JointVector& previous_velocity, const JointLimits& limits,
                                   double period_s) {
  JointVelocityOutcome outcome;
  outcome.bad_input = !(limitsUsable(limits, period_s) && wanted.allFinite() && q.allFinite() &&
                        previous_velocity.allFinite());
  if (!limitsUsable(limits, period_s) || !previous_velocity.allFinite()) {
    return outcome;
  }
  const Box speed{-limits.velocity, limits.velocity};
  Box box = speed;
  if (q.allFinite()) {
    const Box position = positionBox(q, limits, period_s);
    box = {speed.lower.cwiseMax(position.lower), speed.upper.cwiseMin(position.upper)};
  }
  const JointVector target = outcome.bad_input ? JointVector::Zero() : wanted;
  const double speed_scale = scaleInto(speed, target);
  const double scale = scaleInto(box, target);
  outcome.speed_limited = speed_scale < 1.0;
  outcome.position_limited = scale < speed_scale;
  // From the previous velocity straight towards the target, as far as acceleration allows.
  const JointVector step = scale * target - previous_velocity;
  const double part = stepWithin(step, period_s * limits.acceleration);
  outcome.acceleration_limited = part < 1.0;
  const JointVector stepped = previous_velocity + part * step;
  // A shortened step may leave a joint faster than it can brake: that one is held to its box.
  outcome.velocity = stepped.cwiseMax(box.lower).cwiseMin(box.upper);
  outcome.position_limited = outcome.position_limited || outcome.velocity != stepped;
  return outcome;
}

JointVelocityOutcome resolve(const Twist& twist_f, const Jacobian& fJe, const JointVector& q,
                             const JointVector& previous_velocity, const JointLimits& limits,
                             double period_s, const ResolvedRateOptions& options) {
  const double manipulability = std::abs(fJe.determinant());
  const double ratio = manipulability / options.manipulability_threshold;
  const bool damped = ratio < 1.0;
  const double lambda = damped ? options.damping * (1.0 - ratio) : 0.0;
  JointVector wanted;
  if (damped) {
    const Jacobian normal = fJe * fJe.transpose() + lambda * lambda * Jacobian::Identity();
    wanted = fJe.transpose() * normal.ldlt().solve(twist_f);
  } else {
    wanted = fJe.partialPivLu().solve(twist_f);
  }
  JointVelocityOutcome outcome = limitVelocity(wanted, q, previous_velocity, limits, period_s);
  outcome.manipulability = std::isfinite(manipulability) ? manipulability : 0.0;
  outcome.damped = damped;
  return outcome;
}

}  // namespace ringhook
