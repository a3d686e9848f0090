#pragma once

/// \file
/// Joint-space values of a six-axis arm.

#include <Eigen/Core>

#include "core/time.h"

namespace ringhook {

using JointVector = Eigen::Matrix<double, 6, 1>;  ///< [rad], or its derivatives as named
using Jacobian = Eigen::Matrix<double, 6, 6>;     ///< twist = J * joint velocity

/// Limits that a command must respect.
struct JointLimits {
  JointVector lower;         ///< [rad]
  JointVector upper;         ///< [rad]
  JointVector velocity;      ///< magnitude [rad/s]
  JointVector acceleration;  ///< magnitude [rad/s^2]; an assumption, the maker publishes none
  JointVector jerk;          ///< magnitude [rad/s^3]; likewise
};

/// One state message of the arm.
struct ArmState {
  Time time;                     ///< sampling instant
  JointVector position;          ///< [rad]
  JointVector velocity;          ///< measured, differentiated [rad/s]
  bool motion_possible = false;  ///< drives on, no e-stop, no error
};

}  // namespace ringhook
