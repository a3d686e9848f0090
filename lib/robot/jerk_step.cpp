#include "robot/jerk_step.h"

#include <algorithm>
#include <cmath>

namespace ringhook {

double accelerationOfSum(double sum, double step) {
  const double size = std::abs(sum);
  if (size <= step) {
    return sum;
  }
  const double n = std::floor(0.5 * (std::sqrt(1.0 + 8.0 * size / step) - 1.0));
  return std::copysign((size + 0.5 * step * n * (n + 1.0)) / (n + 1.0), sum);
}

namespace {

/// The acceleration nearest to the wanted one that jerk and acceleration permit.
double permitted(double wanted, const JointRate& rate, const JointBounds& bounds) {
  const double smooth = std::clamp(wanted, rate.acceleration - bounds.jerk_step,
                                   rate.acceleration + bounds.jerk_step);
  return std::clamp(smooth, -bounds.acceleration, bounds.acceleration);
}

}  // namespace

JointRate stepTowards(const JointRate& rate, double target, double target_acceleration,
                      const JointBounds& bounds) {
  const auto sumTo = [&](double velocity) { return (velocity - rate.velocity) / bounds.period_s; };
  const double d = bounds.jerk_step;
  // Relative to the target, which was T * target_acceleration behind one period ago.
  const double wanted =
      target_acceleration + accelerationOfSum(sumTo(target) - target_acceleration, d);
  const double kept = std::clamp(wanted, accelerationOfSum(sumTo(-bounds.velocity), d),
                                 accelerationOfSum(sumTo(bounds.velocity), d));
  const double next = permitted(kept, rate, bounds);
  const double velocity = rate.velocity + next * bounds.period_s;
  return {std::clamp(velocity, -bounds.velocity, bounds.velocity), next};
}

JointRate brakingStep(const JointRate& rate, const JointBounds& bounds) {
  const double wanted = accelerationOfSum(-rate.velocity / bounds.period_s, bounds.jerk_step);
  const double next = permitted(wanted, rate, bounds);
  return {rate.velocity + next * bounds.period_s, next};
}

}  // namespace ringhook
