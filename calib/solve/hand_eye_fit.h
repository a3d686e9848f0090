#pragma once

/// \file
/// Robust refinement of camera and target from pose pairs. With D_i = cMt_i^-1 * predicted_i the
/// error of a pair is e_i = (translation of D_i, rotation vector of D_i), in the target's frame;
/// both unknowns move by right increments, camera * exp(a), target * exp(b). Minimised is
///   sum of e_i^T C_i^-1 e_i,   C_i = V_i + diag(s_t^2 I, s_r^2 I),
/// V_i the view's own covariance where vision told it (else 0), s_t and s_r what else there is: the
/// arm's error, or, without V_i, all of it. Both are estimated from the residuals: an error of the
/// translation is so weighed against one of the rotation by what the pairs themselves show.
///
/// 1. Levenberg-Marquardt with Cauchy weights; s_t, s_r from medians (a quarter of wrong pairs
///    does not move them far).
/// 2. Pairs with e^T C^-1 e beyond the 99.9 % point of chi-square with six degrees, widened by
///    leastNoiseShare, are taken out (Hampel et al., "Robust Statistics", 1986); the rest is fitted
///    without weights, s_t, s_r by maximum likelihood; repeated until the same pairs stay.
/// The covariance is the inverse of the normal matrix at the minimum.

#include <optional>
#include <vector>

#include "calib/solve/pose_pairs.h"

namespace ringhook {

using Covariance12 = Eigen::Matrix<double, 12, 12>;

/// Standard deviations per axis, besides the views' own covariance.
struct PairNoise {
  double translation_m = 0.0;
  double rotation_rad = 0.0;
};

struct PairError {
  double translation_m = 0.0;  ///< length of the difference between seen and predicted target
  double rotation_rad = 0.0;   ///< angle of that difference
};

struct HandEyeFit {
  HandEye pose;
  std::vector<bool> used;  ///< one per pair; false: contradicts the others
  PairNoise noise;
  /// Of the small twists (a, b); nothing if the pairs leave a motion undetermined.
  std::optional<Covariance12> covariance;
  Eigen::Matrix<double, 12, 1> weakest;  ///< direction of (a, b) that the pairs tell least of
};

/// The error of one pair and how it moves.
struct PairRow {
  Twist e;  ///< error of the pair: translation [m], rotation vector [rad], in t
  Eigen::Matrix<double, 6, 6> by_camera;  ///< de/da
  Eigen::Matrix<double, 6, 6>
      by_target;  ///< de/db; also by any small twist of the predicted target, at and in t
};
PairRow linearise(const HandEye& pose, const PosePair& pair, EyeSetup setup);

/// C_i of the law above.
Covariance6 pairCovariance(const PosePair& pair, const PairNoise& noise);

/// s_t and s_r of the law above by maximum likelihood over the `used` pairs, from `noise` on.
PairNoise estimateNoise(const HandEye& pose, const std::vector<PosePair>& pairs,
                        const std::vector<bool>& used, EyeSetup setup, PairNoise noise);

/// Noise that was estimated from `residuals` residuals may truly be larger: the 1 % point of
/// chi-square with so many degrees over their number (Wilson and Hilferty 1931), below 1.
double leastNoiseShare(double residuals);

/// Error of one pair.
PairError pairError(const HandEye& pose, const PosePair& pair, EyeSetup setup);

/// Root mean square of both errors; over pairs with `used`.
PairError rms(const std::vector<PairError>& errors);
PairError rmsError(const HandEye& pose, const std::vector<PosePair>& pairs,
                   const std::vector<bool>& used, EyeSetup setup);

/// Median over all pairs of sqrt(translation^2 + (lever * rotation)^2) [m]: one measure for every
/// solution, whatever made it, that up to half of the pairs cannot move.
double medianError(const HandEye& pose, const std::vector<PosePair>& pairs, EyeSetup setup);
constexpr double kErrorLever = 0.1;  ///< lever of medianError [m]: as long as a gripper

/// Steps 1 and 2.
HandEyeFit fitHandEye(const std::vector<PosePair>& pairs, EyeSetup setup, const HandEye& start);

/// Least squares over the `used` pairs from a near start, with noise given.
HandEye refitHandEye(const std::vector<PosePair>& pairs, EyeSetup setup, const HandEye& start,
                     const std::vector<bool>& used, const PairNoise& noise);

}  // namespace ringhook
