#include "calib/solve/time_delay.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "calib/solve/time_offset_fit.h"

namespace ringhook {
namespace {

constexpr double kSlowest = 5.0;  // below, nothing moved [px/s]

/// Standard deviation of the offset: what the residuals' spread says, as independent values and by
/// blocks of time, whichever is larger.
double offsetSigma(const OffsetNormal& normal, const std::vector<OffsetStep>& blocks) {
  const OffsetSquare inverse = normal.H.ldlt().solve(OffsetSquare::Identity());
  OffsetSquare spread = OffsetSquare::Zero();
  for (const OffsetStep& g : blocks) {
    spread += g * g.transpose();
  }
  const auto count = static_cast<double>(blocks.size());
  spread *= count / std::max(0.5 * count, count - kOffsetUnknowns);  // what the fit took away
  const double by_blocks = (inverse * spread * inverse)(0, 0);
  const double variance = normal.squares / std::max(1.0, normal.weights - kOffsetUnknowns);
  const double independent = inverse(0, 0) * variance / (kOffsetSigmaPx * kOffsetSigmaPx);
  return std::sqrt(std::max(by_blocks, independent));
}

double rms(const OffsetNormal& normal) { return std::sqrt(normal.squares / normal.weights); }

std::string milliseconds(double s) {
  return std::to_string(static_cast<int>(std::lround(1e3 * s))) + " ms";
}

/// What the minimum says, beside the one with the offset held at zero.
TimeOffset described(const TimeOffsetFit& fit, const OffsetUnknowns& held,
                     const OffsetUnknowns& best) {
  std::vector<OffsetStep> blocks;
  const OffsetNormal normal = fit.all(best, &blocks);
  TimeOffset found;
  found.offset_s = best.offset_s;
  found.rms_px = rms(normal);
  found.rms_without_px = rms(fit.all(held, nullptr));
  found.image_speed_px_s = std::sqrt(normal.speed / normal.weights);
  found.sigma_s = offsetSigma(normal, blocks);
  found.views = static_cast<int>(fit.views());
  found.eMg = best.eMg;
  found.fMc1 = best.fMc1;
  return found;
}

Outcome<TimeOffset> judged(const TimeOffset& found, const TimeOffsetOptions& options) {
  if (found.image_speed_px_s < kSlowest) {
    return Refusal{"the plate hardly moved in the images"};
  }
  if (found.rms_px > options.largest_rms_px) {
    return Refusal{"the arm's states do not explain what the cameras saw: " +
                   std::to_string(found.rms_px) + " px remain"};
  }
  if (std::abs(found.offset_s) > 0.95 * options.largest_offset_s) {
    return Refusal{"the delay is larger than " + milliseconds(options.largest_offset_s)};
  }
  if (!(found.sigma_s < options.largest_sigma_s)) {
    return Refusal{"the plate moved too little to tell the delay"};
  }
  return found;
}

}  // namespace

Outcome<TimeOffset> findTimeOffset(const PlateMotion& motion, const TimeOffsetOptions& options) {
  if (static_cast<int>(motion.plate.size()) < options.fewest_views) {
    return Refusal{"too few pictures of the plate: " + std::to_string(motion.plate.size()) +
                   ", expected at least " + std::to_string(options.fewest_views)};
  }
  if (motion.flange.size() < 10) {
    return Refusal{"too few states of the arm"};
  }
  const TimeOffsetFit fit(motion, options);
  if (2 * fit.views() < motion.plate.size() ||
      static_cast<int>(fit.views()) < options.fewest_views) {
    return Refusal{"no state of the arm around most pictures: only " + std::to_string(fit.views()) +
                   " of " + std::to_string(motion.plate.size()) + " lie between states"};
  }
  const std::optional<OffsetUnknowns> held = fit.minimise(fit.start(), false);
  const std::optional<OffsetUnknowns> best = held ? fit.minimise(*held, true) : std::nullopt;
  if (!best) {
    return Refusal{"the arm's states do not explain what the cameras saw"};
  }
  return judged(described(fit, *held, *best), options);
}

}  // namespace ringhook
