#include "calib/wizard/place_wiggle.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "servo/quintic.h"

namespace ringhook {
namespace {

constexpr double kRise = 1.0;   // [s]
constexpr double kWrist = 2.5;  // amplitude of joints 4 to 6 against those of 1 to 3
constexpr std::array kSlow = {0.53, 0.47, 0.61, 0.43, 0.57, 0.67};  // [Hz]
constexpr std::array kFast = {1.09, 1.21, 0.97, 1.31, 1.15, 1.37};  // [Hz]

}  // namespace

Wiggle::Wiggle(const JointVector& middle, const WiggleOptions& options)
    : middle_(middle), options_(options) {
  if (!(options.seconds >= 3.0) || !(options.seconds <= 120.0)) {
    throw InputError("the wiggle: expected a duration of 3 to 120 s");
  }
  if (!(options.amplitude_rad > 0.0) || !(options.amplitude_rad <= 0.05)) {
    throw InputError("the wiggle: expected an amplitude of up to 0.05 rad");
  }
}

JointSample Wiggle::at(double t) const {
  const QuinticSample rise = quinticAt(t, kRise);
  const QuinticSample fall = quinticAt(t - (options_.seconds - kRise), kRise);
  const double share = rise.progress * (1.0 - fall.progress);
  const double share_speed =
      rise.rate_per_s * (1.0 - fall.progress) - rise.progress * fall.rate_per_s;
  JointSample sample{middle_, JointVector::Zero()};
  for (std::size_t j = 0; j < 6; ++j) {
    const double amplitude = options_.amplitude_rad * (j < 3 ? 1.0 : kWrist);
    const double w1 = 2.0 * std::numbers::pi * kSlow[j];
    const double w2 = 2.0 * std::numbers::pi * kFast[j];
    const double phase = static_cast<double>(j);
    const double swing = 0.5 * (std::sin(w1 * t) + std::sin(w2 * t + phase));
    const double swing_speed = 0.5 * (w1 * std::cos(w1 * t) + w2 * std::cos(w2 * t + phase));
    const auto i = static_cast<Eigen::Index>(j);
    sample.position[i] += amplitude * share * swing;
    sample.velocity[i] = amplitude * (share * swing_speed + share_speed * swing);
  }
  return sample;
}

}  // namespace ringhook
