#pragma once

/// \file
/// From nothing to a belief: all measurements of the first seconds at once. An extended filter that
/// starts at rest may settle on the wrong swing; a batch cannot be led astray by its own past.
/// First a guess without a start of its own: for every length of a grid the small swing is linear,
/// r + v t + a cos(w t) + b sin(w t), and the length with the least residual wins (variable
/// projection: Golub and Pereyra, SIAM J. Numer. Anal. 10, 1973). Then the nonlinear least-squares
/// fit of the first instant's state, the whole law in between, by Levenberg and Marquardt's method
/// (Marquardt, J. SIAM 11, 1963) with Huber's weights (Ann. Math. Stat. 35, 1964), so that one
/// wrong fix does no harm. Its normal matrix at the solution is the Fisher information, of which
/// the inverse is the Cramer-Rao bound for these data.

#include <span>

#include "core/outcome.h"
#include "prediction/swing_measurement.h"
#include "prediction/swing_walk.h"

namespace ringhook {

/// What is known before the first measurement, at its instant. Zero variance: known, not estimated.
/// Independent of each other but for the reach: only the diagonal of the covariance is used.
struct SwingPrior : SwingBelief {
  /// Everything zero, and known to be.
  SwingPrior() : SwingBelief{SwingVector::Zero(), SwingMatrix::Zero()} {}

  /// \param place of the state vector. \param sigma standard deviation, in the state's unit.
  void know(int place, double value, double sigma) {
    mean(place) = value;
    covariance(place, place) = sigma * sigma;
  }

  /// How far the tracked point lies below the pivot, per effective length: 1 for a weight on a
  /// string, 1.5 for the lower end of a rod. A small swing at even speed hardly tells; a belt that
  /// stops needs it. Standard deviation of its logarithm; 0: nothing is known of it.
  double reach_per_length = 1.2;
  double reach_sigma = 0.0;
};

/// Guess of the state at the first measurement. Precondition: at least one measurement, all of the
/// same sight, times growing.
SwingVector guessSwing(std::span<const SwingMeasurement> measurements, const SwingPrior& prior,
                       const SwingLaw& law, const Eigen::Vector3d& pivot_o);

struct SwingFit {
  SwingBelief start;        ///< at the first measurement
  SwingBelief end;          ///< at the last measurement, by the law alone
  double cost = 0.0;        ///< half of what was minimised, prior and weights included
  double chi_square = 0.0;  ///< of the residuals, without the prior
  int residuals = 0;        ///< numbers that went into it
  int iterations = 0;
};

/// Most probable state at the first measurement given them all and the prior. Refuses "fit did not
/// converge" and "no measurement".
Outcome<SwingFit> fitSwing(std::span<const SwingMeasurement> measurements, const SwingPrior& prior,
                           const SwingVector& guess, const SwingLaw& law,
                           const Eigen::Vector3d& pivot_o);

}  // namespace ringhook
