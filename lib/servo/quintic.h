#pragma once

/// \file
/// Minimum-jerk time scaling from 0 to 1 in time T: s(u) = 10 u^3 - 15 u^4 + 6 u^5, u = t / T
/// (Flash and Hogan, "The coordination of arm movements", J. Neurosci. 1985).

#include <algorithm>
#include <cmath>

namespace ringhook {

struct QuinticSample {
  double progress = 0.0;    ///< s, from 0 to 1
  double rate_per_s = 0.0;  ///< ds/dt [1/s]
};

/// At rest before 0 and after `duration_s`; at the end if the duration is not positive.
inline QuinticSample quinticAt(double t, double duration_s) {
  if (!(duration_s > 0.0) || t >= duration_s) {
    return {1.0, 0.0};
  }
  const double u = std::max(0.0, t / duration_s);
  return {u * u * u * (10.0 + u * (6.0 * u - 15.0)),
          30.0 * u * u * (1.0 - u) * (1.0 - u) / duration_s};
}

/// Least duration [s] for a distance [m or rad] under peak speed [per s] and acceleration
/// [per s^2], both positive.
inline double quinticDuration(double distance, double speed, double acceleration) {
  constexpr double kPeakSpeed = 15.0 / 8.0;
  const double peak_acceleration = 10.0 / std::sqrt(3.0);
  return std::max(kPeakSpeed * distance / speed,
                  std::sqrt(peak_acceleration * distance / acceleration));
}

}  // namespace ringhook
