#pragma once

/// \file
/// The pose of a hanging hook as pivot and angles, exactly and both ways.
/// Law: fRo = Rx(swing_x) Ry(swing_y) Rz(yaw), f_pivot = fMo * pivot_o. The shank's direction
/// u = fRo (0, 0, -1) = (-sin y, sin x cos y, -cos x cos y) gives the two swing angles,
///   swing_x = atan2(u_y, -u_z),  swing_y = atan2(-u_x, hypot(u_y, u_z)),
/// and what rotation is left fixes the z axis, so it is a pure yaw. Unique for |swing_y| < 90 deg.
/// Small changes (pivot, swing_x, swing_y, yaw) and the small twist d of fMo * exp(d) are joined by
/// an invertible 6x6 matrix, which carries covariances across: with G the angle rates' axes in o,
///   d_rotation = G d_angles,  d_translation = fRo^T d_pivot + skew(pivot_o) G d_angles.

#include <Eigen/Core>

#include "core/pose.h"

namespace ringhook {

struct HangingPose {
  Eigen::Vector3d pivot_f;  ///< pivot in f [m]
  double swing_x = 0.0;     ///< about the x axis of f; hanging straight = 0 [rad]
  double swing_y = 0.0;     ///< about the once turned y axis; hanging straight = 0 [rad]
  double yaw = 0.0;         ///< about the shank [rad]
};

/// `pivot_o`: the pivot in the hook frame [m].
HangingPose hangingFromPose(const Pose& fMo, const Eigen::Vector3d& pivot_o);

/// Exact inverse of hangingFromPose.
Pose poseFromHanging(const HangingPose& hanging, const Eigen::Vector3d& pivot_o);

/// 6x6 matrix J with d = J (d pivot_f [m], d swing_x, d swing_y, d yaw [rad]).
Eigen::Matrix<double, 6, 6> hangingJacobian(const HangingPose& hanging,
                                            const Eigen::Vector3d& pivot_o);

/// Velocity at o, expressed in f [m/s, rad/s], from the pivot's velocity in f [m/s] and the rates
/// of (swing_x, swing_y, yaw) [rad/s].
Twist hangingTwist(const HangingPose& hanging, const Eigen::Vector3d& pivot_o,
                   const Eigen::Vector3d& pivot_velocity_f, const Eigen::Vector3d& angle_rates);

}  // namespace ringhook
