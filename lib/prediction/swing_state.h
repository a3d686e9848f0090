#pragma once

/// \file
/// What is believed of a swinging thing below a travelling pivot: its motion and, in the same
/// vector, what it is like. Everything that is learnt while watching is a state (Jazwinski,
/// "Stochastic Processes and Filtering Theory", 1970, section 8.4); what is known beforehand has a
/// variance of zero, and then no measurement moves it.
///
/// Geometry: fRo = Rx(swing_x) Ry(swing_y) Rx(rest_x) Ry(rest_y) Rz(yaw). The first two turns are
/// those of a universal joint whose first axis is x_f, and all that gravity knows of; the rest is
/// how the model's frame o lies in the body that swings, whose centre of mass is below its pivot.
/// The tracked point o: fPo = pivot - fRo * (pivot_o + (0, 0, longer)).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "prediction/linear_kalman.h"

namespace ringhook {

/// Places in the state vector.
enum SwingPlace : int {
  kSwingPivot = 0,         ///< pivot in f, three [m]
  kSwingSpeed = 3,         ///< of the pivot, three [m/s]
  kSwingAcceleration = 6,  ///< of the pivot, three [m/s^2]
  kSwingAngle = 9,         ///< swing_x, swing_y [rad]
  kSwingRate = 11,         ///< of the swing angles [rad/s]
  kSwingLogLength = 13,    ///< ln of the effective length about x, in metres
  kSwingLengthRatio = 14,  ///< ln of (effective length about y / about x)
  kSwingViscous = 15,      ///< damping proportional to the rate, both axes [1/s]
  kSwingDry = 16,          ///< damping by dry friction, both axes [rad/s^2]
  kSwingLonger = 17,       ///< by how much the pivot lies above pivot_o along the shank [m]
  kSwingRest = 18,         ///< rest_x, rest_y [rad]
  kSwingYaw = 20,          ///< about the shank [rad]
  kSwingStates = 21,
  kSwingMoving = 13  ///< the first so many move, the others are constants
};

using SwingVector = Eigen::Matrix<double, kSwingStates, 1>;
using SwingMatrix = Eigen::Matrix<double, kSwingStates, kSwingStates>;
using SwingBelief = Gaussian<kSwingStates>;

/// Standard deviation of one state, in its unit.
inline double sigmaOf(const SwingBelief& belief, int place) {
  return std::sqrt(std::max(0.0, belief.covariance(place, place)));
}

}  // namespace ringhook
