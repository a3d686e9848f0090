#pragma once

/// \file
/// Made-up robot and camera whose truth is known: pairs as a noisy arm and a noisy camera would
/// give them, with everything that goes wrong in practice.

#include <random>
#include <string>
#include <vector>

#include "calib/solve/pose_pairs.h"

namespace ringhook {

struct PairScene {
  EyeSetup setup = EyeSetup::kEyeToHand;
  int pairs = 20;
  double turn_rad = 0.5;          ///< the flange's turns about each axis: uniform within +-
  double travel_m = 0.2;          ///< its moves along each axis: uniform within +-
  double axis_spread = 1.0;       ///< turns about the other axes; 0: all about one axis
  double translation_m = 0.0003;  ///< noise of the seen target across the line of sight, per axis
  double depth_factor = 1.0;      ///< how much larger along it
  double rotation_rad = 0.002;    ///< noise of the seen target, per axis
  double wrong_share = 0.0;       ///< pairs that have nothing to do with each other
  int swapped = 0;                ///< exchanges of the targets of two neighbours
};

struct MadePairs {
  std::vector<PosePair> pairs;
  HandEye truth;
  std::vector<bool> wrong;  ///< one per pair
};

/// Different `dice` make a different camera, tool, poses and noise.
MadePairs makePairs(const PairScene& scene, std::mt19937_64& dice);

/// e^T C^-1 e of the error e = (a, b) of a result (hand_eye_fit.h): 12 on average if C is right.
double mahalanobis2(const HandEye& pose, const Eigen::Matrix<double, 12, 12>& covariance,
                    const HandEye& truth);

/// A rotation about a random axis by a random angle up to `most` [rad].
Eigen::Matrix3d randomRotation(std::mt19937_64& dice, double most);

}  // namespace ringhook
