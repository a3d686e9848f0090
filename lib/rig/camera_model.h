#pragma once

/// \file
/// One real camera: pinhole matrix and lens distortion, and both ways between an ideal ray and the
/// pixel where the sensor sees it. Law (OpenCV's published model; Brown 1966, Heikkila and Silven
/// 1997), with r^2 = x^2 + y^2 of the normalised point (x, y) = (X/Z, Y/Z):
///   s   = (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6)
///   x_d = s x + 2 p1 x y + p2 (r^2 + 2 x^2)
///   y_d = s y + p1 (r^2 + 2 y^2) + 2 p2 x y
///   u   = fx x_d + cx,   v = fy y_d + cy.
/// The polynomial s r stops growing at some radius (the fold) for many lenses; beyond it one pixel
/// would have two rays, so nothing beyond it is accepted by the inverse.

#include <Eigen/Core>

#include "core/outcome.h"

namespace ringhook {

struct CameraModel {
  int width = 0;                                    ///< of the full image [px]
  int height = 0;                                   ///< of the full image [px]
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();  ///< fx 0 cx; 0 fy cy; 0 0 1 [px]
  Eigen::VectorXd distortion = Eigen::VectorXd(0);  ///< 0, 4, 5 or 8 of k1 k2 p1 p2 k3 k4 k5 k6
};

/// Lens distortion of a normalised point: (x, y) to (x_d, y_d), both without unit.
/// `jacobian` (2x2, d(x_d, y_d)/d(x, y)) is filled when given.
Eigen::Vector2d distortNormalised(const CameraModel& camera, const Eigen::Vector2d& normalised,
                                  Eigen::Matrix2d* jacobian = nullptr);

/// Pixel [px] at which the sensor sees the ideal ray (x, y, 1).
Eigen::Vector2d projectNormalised(const CameraModel& camera, const Eigen::Vector2d& normalised);

/// Ideal ray (x, y, 1) of a sensor pixel [px]: Newton's method on the law above to 1e-13.
/// Refuses "pixel beyond the lens model" where the method does not converge or ends past the fold.
Outcome<Eigen::Vector2d> undistortPixel(const CameraModel& camera, const Eigen::Vector2d& pixel);

/// Normalised radius up to which s r grows; infinity for a model that never folds below 10.
double foldRadius(const CameraModel& camera);

}  // namespace ringhook
