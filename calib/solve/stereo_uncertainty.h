#pragma once

/// \file
/// What the noise of the corners leaves in the result, by first-order propagation (Hartley and
/// Zisserman, "Multiple View Geometry", 2004, chapter 5): one standard deviation of every
/// parameter, and what they do together to a point that the rig measures. Errors that all views
/// share (a wrong square, a bent board taken for flat) are not in it.

#include <Eigen/Core>

#include "calib/solve/stereo_problem.h"

namespace ringhook {

/// Distance at which the consequence is told: the work of the cell this project is made for [m].
constexpr double kTypicalDistance_m = 1.3;

struct LensSigma {
  Eigen::Vector2d focal_px = Eigen::Vector2d::Zero();   ///< fx, fy [px]
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  ///< cx, cy [px]
  Eigen::VectorXd distortion = Eigen::VectorXd(0);      ///< as in CameraModel
};

struct Uncertainty {
  LensSigma left;
  LensSigma right;
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();   ///< of c2Mc1's rotation vector
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();  ///< of c2Mc1 [m]
  double baseline_m = 0.0;  ///< of the distance between the optical centres [m]
  double focal_px = 0.0;    ///< largest of the four focal lengths' [px]
  /// Of a triangulated point, in c1, kTypicalDistance_m away midway between the optical axes; the
  /// calibration's part alone, which repeats from picture to picture [m].
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

/// \param covariance see RigCovariance. \param sigma_px corner noise per axis [px].
Uncertainty uncertaintyOf(const StereoRig& rig, const RigCovariance& covariance, double sigma_px);

}  // namespace ringhook
