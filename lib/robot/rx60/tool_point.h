#pragma once

/// \file
/// Where one point of the tool is, how fast joint speeds move it, and how near the arm is to a
/// singularity: what must be known hundreds of times a period, hence without frames and
/// determinants.
///
/// Law: the wrist is spherical, so the determinant of the Jacobian factorises into the arm's and
/// the wrist's: |det J| = L2 L4 |sin q3| |L2 sin q2 + L4 sin(q2 + q3)| |sin q5|; it does not depend
/// on the point of the tool. The wrist centre is r = L2 sin q2 + L4 sin(q2 + q3) in front of the
/// axis of joint 1 within the arm's plane.

#include "robot/rx60/kinematics.h"

namespace ringhook::rx60 {

struct ToolPoint {
  Eigen::Vector3d position;        ///< in f [m]
  Eigen::Matrix<double, 3, 6> fJ;  ///< velocity in f [m/s] per joint velocity [rad/s]
  double manipulability = 0.0;     ///< |det J| of the flange's Jacobian [m^3]
};

/// At joint angles q [rad], for the point `tool_e` given in the flange's frame e [m].
ToolPoint toolPoint(const Geometry& geometry, const Eigen::Vector3d& tool_e, const JointVector& q);

}  // namespace ringhook::rx60
