#include "prediction/swing_smoother.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace ringhook {
namespace {

/// One step of the forward pass.
struct Forward {
  SwingBelief predicted;
  SwingBelief filtered;
  SwingMatrix Phi;  ///< from the step before
};

// X = A P^-1 for a covariance whose states differ in size by many powers of ten and of which some
// are known exactly: scaled to correlations, known states out of the way.
SwingMatrix overCovariance(const SwingMatrix& A, const SwingMatrix& P) {
  SwingVector scale;
  for (int i = 0; i < kSwingStates; ++i) {
    scale(i) = P(i, i) > 0.0 ? 1.0 / std::sqrt(P(i, i)) : 0.0;
  }
  SwingMatrix correlation = scale.asDiagonal() * P * scale.asDiagonal();
  for (int i = 0; i < kSwingStates; ++i) {
    correlation(i, i) = 1.0;
  }
  const SwingMatrix scaled = A * scale.asDiagonal();
  const SwingMatrix solved = correlation.ldlt().solve(scaled.transpose()).transpose();
  return solved * scale.asDiagonal();
}

std::vector<Forward> forwards(std::span<const SwingMeasurement> measurements,
                              const SwingBelief& start, const SwingFilterOptions& options,
                              SwingMode mode) {
  const SwingNoise noise = swingNoise(options, mode);
  std::vector<Forward> steps;
  SwingBelief belief = start;
  Time time = measurements.front().time;
  for (const SwingMeasurement& measurement : measurements) {
    const SwingBeliefWalk walk =
        walkSwingBeliefWithTransition(belief, measurement.time - time, options.law, noise);
    const SwingCorrection correction = correctSwing(walk.belief, measurement, options.pivot_o);
    const bool taken = correction.nis <= options.gate.bound(measurement.sight);
    belief = taken ? correction.belief : walk.belief;
    time = measurement.time;
    steps.push_back({walk.belief, belief, walk.Phi});
  }
  return steps;
}

}  // namespace

Outcome<std::vector<SwingBelief>> smoothSwing(std::span<const SwingMeasurement> measurements,
                                              const SwingFilterOptions& options, SwingMode mode) {
  if (measurements.empty()) {
    return Refusal{"no measurement"};
  }
  const SwingVector guess = guessSwing(measurements, options.prior, options.law, options.pivot_o);
  const Outcome<SwingFit> fit =
      fitSwing(measurements, options.prior, guess, options.law, options.pivot_o);
  if (!fit) {
    return Refusal{fit.reason()};
  }
  const std::vector<Forward> steps =
      forwards(measurements, {fit->start.mean, options.prior.covariance}, options, mode);
  std::vector<SwingBelief> smoothed(steps.size());
  smoothed.back() = steps.back().filtered;
  for (std::size_t k = steps.size() - 1; k-- > 0;) {
    const Forward& now = steps[k];
    const Forward& next = steps[k + 1];
    const SwingMatrix C =
        overCovariance(now.filtered.covariance * next.Phi.transpose(), next.predicted.covariance);
    smoothed[k].mean = now.filtered.mean + C * (smoothed[k + 1].mean - next.predicted.mean);
    const SwingMatrix P =
        now.filtered.covariance +
        C * (smoothed[k + 1].covariance - next.predicted.covariance) * C.transpose();
    smoothed[k].covariance = 0.5 * (P + P.transpose());
  }
  return smoothed;
}

}  // namespace ringhook
