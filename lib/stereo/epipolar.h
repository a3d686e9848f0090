#pragma once

/// \file
/// Epipolar geometry of a calibrated pair (the 2007 report (Jeyabalan, Fork project), eq. 2.8 to
/// 2.12; Hartley and Zisserman, "Multiple View Geometry", 2nd ed., chapter 9). With c2Mc1 = (R, t)
/// and undistorted homogeneous pixels x, x':
///   E = [t]x R,   F = K2^-T E K1^-1,   x'^T F x = 0,   l' = F x,   l = F^T x',
/// and the epipoles are the null vectors, F e = 0 and F^T e' = 0.

#include <Eigen/Core>

#include "core/pinhole_view.h"
#include "rig/stereo_rig.h"

namespace ringhook {

/// Essential matrix of normalised coordinates; its scale is the baseline [m].
Eigen::Matrix3d essentialMatrix(const Pose& c2Mc1);

/// Fundamental matrix of undistorted pixel coordinates, Frobenius norm 1.
Eigen::Matrix3d fundamentalMatrix(const Eigen::Matrix3d& K1, const Eigen::Matrix3d& K2,
                                  const Pose& c2Mc1);

/// The same for a rig of two cameras (pixels undistorted, not rectified). Throws InputError for a
/// rig of one camera.
Eigen::Matrix3d fundamentalMatrix(const StereoRig& rig);

/// The same for two ideal views, rectified or not.
Eigen::Matrix3d fundamentalMatrix(const PinholeView& left, const PinholeView& right);

/// Line (a, b, c), a u + b v + c = 0 with a^2 + b^2 = 1, in the right image of a left pixel [px].
Eigen::Vector3d epipolarLineInRight(const Eigen::Matrix3d& F, const Eigen::Vector2d& left_px);

/// Line in the left image of a right pixel [px], normalised alike.
Eigen::Vector3d epipolarLineInLeft(const Eigen::Matrix3d& F, const Eigen::Vector2d& right_px);

/// Images of the other camera's centre, homogeneous, norm 1: third value 0 means at infinity.
struct Epipoles {
  Eigen::Vector3d left;   ///< F left = 0
  Eigen::Vector3d right;  ///< F^T right = 0
};
Epipoles epipoles(const Eigen::Matrix3d& F);

/// Root mean square of both pixels' distances to their epipolar lines [px].
double symmetricEpipolarDistance(const Eigen::Matrix3d& F, const Eigen::Vector2d& left_px,
                                 const Eigen::Vector2d& right_px);

}  // namespace ringhook
