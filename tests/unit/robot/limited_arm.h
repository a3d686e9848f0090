#pragma once

/// \file
/// A limiter before an ideal arm, and a place where nothing bends a moderate velocity.

#include "robot/limiter.h"

namespace ringhook {

inline constexpr double kPeriod = 0.004;  // [s]

/// Away from limits and singularities.
inline JointVector middle() {
  JointVector q;
  q << 0.2, 0.3, 1.5, 0.1, -0.8, 0.3;
  return q;
}

/// A limiter and an arm that does exactly what it is sent.
struct LimitedArm {
  explicit LimitedArm(const JointVector& start, const LimiterSettings& the_settings = {})
      : settings(the_settings), limiter(settings), q(start) {}

  LimitedVelocity step(const JointVector& wanted, OperatingMode mode = OperatingMode::kAutomatic) {
    const LimitedVelocity out = limiter.limit(wanted, q, mode);
    q += kPeriod * out.velocity;
    return out;
  }
  LimitedVelocity run(int periods, const JointVector& wanted,
                      OperatingMode mode = OperatingMode::kAutomatic) {
    LimitedVelocity last;
    for (int k = 0; k < periods; ++k) {
      last = step(wanted, mode);
    }
    return last;
  }
  [[nodiscard]] double toolSpeed(const JointVector& v) const {
    const Twist twist = rx60::jacobian(settings.geometry, q) * v;
    const Eigen::Vector3d arm = rx60::forward(settings.geometry, q).linear() * settings.tool_e;
    return (twist.head<3>() + twist.tail<3>().cross(arm)).norm();
  }

  LimiterSettings settings;
  Limiter limiter;
  JointVector q;
};

}  // namespace ringhook
