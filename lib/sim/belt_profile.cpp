#include "sim/belt_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ringhook {
namespace {

/// Speed and travel gained by the drive since some instant.
struct Gain {
  double speed = 0.0;   ///< [m/s]
  double travel = 0.0;  ///< [m]
};

/// An S-curve: jerk for `corner`, constant acceleration, jerk the other way for `corner`.
struct SCurve {
  double corner;    ///< [s]
  double duration;  ///< of all three together [s]
};

SCurve sCurve(const BeltProfile& profile, double difference) {
  const double size = std::abs(difference);
  const double a = profile.acceleration;
  const double j = profile.jerk;
  if (size * j <= a * a) {
    const double corner = std::sqrt(size / j);
    return {corner, 2.0 * corner};
  }
  return {a / j, size / a + a / j};
}

/// What a change by `difference` has gained `t` [s] after it began, within its duration.
Gain gainWithin(const BeltProfile& profile, double difference, double t) {
  const SCurve curve = sCurve(profile, difference);
  const double j = std::copysign(profile.jerk, difference);
  const double c = curve.corner;
  if (t < c) {
    return {0.5 * j * t * t, j * t * t * t / 6.0};
  }
  const double left = curve.duration - t;
  if (left > c) {
    const double r = t - c;
    return {j * c * (0.5 * c + r), j * c * (c * c / 6.0 + 0.5 * c * r + 0.5 * r * r)};
  }
  return {difference - 0.5 * j * left * left,
          difference * (0.5 * curve.duration - left) + j * left * left * left / 6.0};
}

/// Speed of the drive at `time_s`, and its travel until then.
Gain drive(const BeltProfile& profile, double time_s) {
  double speed = profile.initial_speed;
  double travel = speed * time_s;
  for (const SpeedChange& change : profile.changes) {
    const double since = time_s - change.begin_s;
    if (since <= 0.0) {
      break;
    }
    const double difference = change.to - speed;
    const double lasts = changeDuration(profile, difference);
    const Gain gain = gainWithin(profile, difference, std::min(since, lasts));
    travel += gain.travel + difference * std::max(0.0, since - lasts);
    speed += gain.speed;
  }
  return {speed, travel};
}

double wave(const BeltProfile& profile, std::size_t index) {
  return 2.0 * std::numbers::pi * static_cast<double>(index + 1) / profile.pitch;
}

}  // namespace

double changeDuration(const BeltProfile& profile, double difference) {
  return sCurve(profile, difference).duration;
}

double beltSpeed(const BeltProfile& profile, double time_s) {
  const Gain now = drive(profile, time_s);
  double factor = 1.0;
  for (std::size_t i = 0; i < profile.ripple.size(); ++i) {
    const BeltRipple& ripple = profile.ripple[i];
    factor += ripple.fraction * std::cos(wave(profile, i) * now.travel + ripple.phase);
  }
  return now.speed * factor;
}

double beltTravel(const BeltProfile& profile, double time_s) {
  const double driven = drive(profile, time_s).travel;
  double travel = driven;
  for (std::size_t i = 0; i < profile.ripple.size(); ++i) {
    const BeltRipple& ripple = profile.ripple[i];
    travel += ripple.fraction / wave(profile, i) *
              (std::sin(wave(profile, i) * driven + ripple.phase) - std::sin(ripple.phase));
  }
  return travel;
}

}  // namespace ringhook
