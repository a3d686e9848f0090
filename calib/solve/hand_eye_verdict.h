#pragma once

/// \file
/// Whether a robot-camera calibration may be used, and what to do if not. A fit with small
/// residuals can be wrong by centimetres: parallel rotation axes leave the position along them
/// open, small rotations magnify noise, few pairs flatter themselves. So the verdict rests on the
/// uncertainty of the result, taken at a level that a true error exceeds in one of a thousand
/// cases:
///   bound = sqrt(16.3 / leastNoiseShare(n)) * sigma,
/// sigma the largest standard deviation over directions (the larger of model and jackknife; Efron,
/// "The Jackknife", 1982), 16.3 the 99.9 % point of chi-square with three degrees, n the number of
/// residuals that the noise was estimated from. Beyond it: too many contradicting pairs, a
/// convention that fits better, held-out errors far above the residuals.

#include "calib/solve/hand_eye.h"

namespace ringhook {

struct VerdictLimits {
  double usable_m = 0.005;       ///< bound of the camera's position
  double usable_rad = 0.01;      ///< bound of its orientation
  double good_m = 0.001;         ///< bound in the workspace
  double rejected_share = 0.25;  ///< more wrong pairs than this leave no trust in the others
  double heldout_ratio = 3.0;    ///< of held-out error to residual
};

/// The factor on sigma above. \param residuals number of scalar residuals minus unknowns.
double boundFactor(double residuals);

/// Judges the figures of a finished result.
Verdict judge(const HandEyeResult& result, const VerdictLimits& limits = {});

/// Which motion would tell most: how far the flange was turned about its own axes, and about which
/// to turn it more. Empty if all three were turned well.
std::string motionAdvice(const std::vector<PosePair>& pairs);

}  // namespace ringhook
