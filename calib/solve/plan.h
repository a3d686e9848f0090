#pragma once

/// \file
/// What a stereo rig will be able to measure, before it is built: section 2.5 of the 2007 report
/// (Jeyabalan, Fork project) as numbers. Uncertainty of a point is that of the triangulation with
/// least reprojection error (stereo/triangulation.h) to first order. With J (4x3) the derivative of
/// both undistorted pixels by the point and S the covariance of these pixels,
///   C = A S A^T,   A = (J^T J)^-1 J^T,
/// where S is sigma^2 taken through the inverse of the lens distortion; for an ideal lens
/// C = sigma^2 (J^T J)^-1, the Cramer-Rao bound. Two cameras that cross on a point at range R from
/// both, at distance Z from the middle of the baseline B, have
///   sigma_z = sqrt(2) R^2 sigma / (f B),  sigma_x = R^2 sigma / (sqrt(2) f Z),
///   sigma_y = R sigma / (sqrt(2) f).
///
/// Frame m, used by plans only: origin in the middle of the baseline, x along it towards the right
/// camera, z the mean of both optical axes, y down. Lengths of a plan are given in it.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/pose.h"
#include "rig/stereo_rig.h"

namespace ringhook {

struct PlannedSensor {
  int width = 2048;          ///< [px]
  int height = 2048;         ///< [px]
  double focal_px = 2500.0;  ///< lens over pixel pitch [px]
};

/// Two equal cameras, both turned inwards by half the vergence about their y axis.
struct PlannedSetup {
  PlannedSensor sensor;
  double baseline_m = 0.4;    ///< between the optical centres [m]
  double vergence_rad = 0.0;  ///< between the optical axes [rad]
};

/// Lens without distortion, principal point in the middle of the image.
StereoRig plannedRig(const PlannedSetup& setup);

/// Vergence [rad] at which the axes cross at this distance [m] from the middle of the baseline.
double crossingVergence(double baseline_m, double distance_m);

/// A rig as a plan looks at it. Throws InputError for a rig of one camera.
struct PlanView {
  explicit PlanView(const StereoRig& given);

  StereoRig rig;
  Pose c1Mm;                  ///< the plan's frame in the left camera
  double baseline_m = 0.0;    ///< [m]
  double vergence_rad = 0.0;  ///< angle between the optical axes [rad]
  double left_fold = 0.0;     ///< normalised radius up to which the lens model holds
  double right_fold = 0.0;    ///< likewise

  /// Distance [m] at which the axes come closest to each other; nothing if they part.
  [[nodiscard]] std::optional<double> crossingDistance() const;
  /// Smallest distance [px] of the point's two images from an image border, negative outside;
  /// minus infinity behind a camera or beyond its lens model. \param point_m in frame m [m].
  [[nodiscard]] double room(const Eigen::Vector3d& point_m) const;
};

/// First-order covariance [m^2] in frame m of a point at point_m [m], for noise sigma_px per pixel
/// axis [px]. Precondition: view.room(point_m) >= 0.
Eigen::Matrix3d pointCovariance(const PlanView& view, const Eigen::Vector3d& point_m,
                                double sigma_px);

/// The same of the pose mMo of a target with corners at points_o [m] (three or more, not on one
/// line), seen whole by both cameras: of the small twist d in mMo * exp(d) [m^2, rad^2].
Covariance6 targetCovariance(const PlanView& view, const std::vector<Eigen::Vector3d>& points_o,
                             const Pose& mMo, double sigma_px);

/// Corners of a square tag [m] in its own frame.
std::vector<Eigen::Vector3d> tagCornersOf(double size_m);

/// What both cameras see of the plane at one distance.
struct StereoField {
  double distance_m = 0.0;       ///< of the plane z = distance [m]
  double area_m2 = 0.0;          ///< 0: nothing [m^2]
  Eigen::Vector2d low_m{0, 0};   ///< least x and y through the middle of the field [m]
  Eigen::Vector2d high_m{0, 0};  ///< largest x and y through it [m]
  [[nodiscard]] bool empty() const { return !(area_m2 > 0.0); }
};
StereoField stereoField(const PlanView& view, double distance_m);

}  // namespace ringhook
