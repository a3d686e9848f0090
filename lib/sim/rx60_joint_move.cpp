#include "sim/rx60_joint_move.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace ringhook {

Rx60JointMove::Rx60JointMove(const JointVector& start, const JointVector& goal, double share,
                             const JointLimits& limits)
    : start_(start), goal_(goal) {
  assert(share > 0.0 && share <= 1.0);
  double speed = std::numeric_limits<double>::infinity();
  double acceleration = speed;
  for (int i = 0; i < 6; ++i) {
    const double way = std::abs(goal[i] - start[i]);
    if (way > 0.0) {
      speed = std::min(speed, share * limits.velocity[i] / way);
      acceleration = std::min(acceleration, limits.acceleration[i] / way);
    }
  }
  if (std::isinf(speed)) {
    return;  // already there
  }
  // A way too short for the full speed makes the trapezoid a triangle.
  peak_speed_ = std::min(speed, std::sqrt(acceleration));
  ramp_ = peak_speed_ / acceleration;
  duration_ = 1.0 / peak_speed_ + ramp_;
}

JointVector Rx60JointMove::position(double time_s) const {
  if (time_s >= duration_) {
    return goal_;
  }
  const double t = std::max(0.0, time_s);
  const double left = duration_ - t;
  double s = 0.0;
  if (t < ramp_) {
    s = 0.5 * peak_speed_ * t * t / ramp_;
  } else if (left < ramp_) {
    s = 1.0 - 0.5 * peak_speed_ * left * left / ramp_;
  } else {
    s = peak_speed_ * (t - 0.5 * ramp_);
  }
  return start_ + s * (goal_ - start_);
}

}  // namespace ringhook
