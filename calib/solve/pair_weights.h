#pragma once

/// \file
/// How the errors of pairs are weighed against each other, decided by what pairs left out show.
/// The weights of hand_eye_fit.h are the best if errors are as believed. A lens model that is off,
/// a plate that is bent or an arm that was still moving make them otherwise: then the covariances
/// that views tell are too sure of some pairs and throw others away. So there are three ways:
///   kViews          C_i = V_i + diag(s_t^2 I, s_r^2 I), as there; where views tell V_i
///   kPairs          C_i = diag(s_t^2 I, s_r^2 I): every pair counts the same
///   kRotationFirst  rotations by themselves, then translations under them (Park and Martin 1994,
///                   Shah 2013): nothing wrong with lengths (tag, focal length, arm) turns the
///                   camera
/// The first of them that there is stands, unless another predicts pairs left out clearly better,
/// by more than two standard errors; of several that do, the one with the least product of the RMS
/// held-out translation and rotation is taken. That product is what Box and Draper minimise where
/// responses of different units have unknown variances ("The Bayesian estimation of common
/// parameters from several responses", Biometrika 52, 1965), here of left out pairs (Stone,
/// "Cross-validatory choice and assessment of statistical predictions", JRSS B 36, 1974): no lever
/// between millimetres and degrees has to be told.

#include <optional>
#include <string>
#include <vector>

#include "calib/solve/hand_eye_fit.h"

namespace ringhook {

enum class PairWeights { kViews, kPairs, kRotationFirst };

/// "covariances of the views", "scatter of the pairs", "rotation first".
std::string toString(PairWeights weights);

/// What leaving pairs out shows.
struct LeftOut {
  std::vector<PairError> errors;  ///< of every pair used: predicted by a fit without it
  PairError rms;                  ///< of them
  Covariance12 jackknife = Covariance12::Zero();  ///< of (a, b), see hand_eye_fit.h (Efron 1982)
};

/// A result under weights of one kind.
struct WeighedFit {
  PairWeights weights = PairWeights::kPairs;
  HandEye pose;
  PairNoise noise;  ///< beside the views' covariances with kViews, all there is otherwise
  std::optional<Covariance12> covariance;  ///< of the small twists (a, b), see hand_eye_fit.h
  LeftOut left_out;
};

/// The way that stands unless refuted: kViews if views told covariances, else kPairs.
PairWeights believedWeights(const std::vector<PosePair>& pairs);

/// Every used pair left out once, under the weights of `fit`, started from its pose.
LeftOut leaveEachOut(const std::vector<PosePair>& pairs, EyeSetup setup, const WeighedFit& fit,
                     const std::vector<bool>& used);

/// Every way there is, the believed one first: that one is `believed` itself.
/// Precondition: at least three pairs used, which leave no motion undetermined.
std::vector<WeighedFit> fitInEveryWay(const std::vector<PosePair>& pairs, EyeSetup setup,
                                      const HandEyeFit& believed);

/// Index of the fit to take, by the rule above.
std::size_t chosenFit(const std::vector<WeighedFit>& fits);

}  // namespace ringhook
