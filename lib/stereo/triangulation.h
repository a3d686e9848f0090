#pragma once

/// \file
/// A point from its two pixels. Two ways, side by side:
/// - midpoint of the common perpendicular of both rays (the 2007 report (Jeyabalan, Fork project),
///   section 2.2.2): with origins o_i, unit directions d_i, P_i = I - d_i d_i^T,
///   X = (P_1 + P_2)^-1 (P_1 o_1 + P_2 o_2); closed form, but it weighs errors in space, not
///   pixels;
/// - least reprojection error, the maximum-likelihood point for equal Gaussian noise per pixel
///   axis (Hartley and Sturm, "Triangulation", CVIU 1997), by Gauss-Newton from the midpoint.
/// Covariances are first-order: midpoint by the derivative of the closed form, optimal by
/// sigma^2 (J^T J)^-1 with the 4x3 Jacobian of both pixels, which is the Cramer-Rao bound.

#include <Eigen/Core>

#include "core/outcome.h"
#include "core/pinhole_view.h"

namespace ringhook {

struct TriangulationOptions {
  double smallest_angle_rad = 1e-3;  ///< between the rays; 0.3 m baseline seen from 300 m
  double largest_residual_px = 2.0;  ///< RMS over the four pixel residuals
};

struct TriangulatedPoint {
  Eigen::Vector3d point_c1;    ///< in the left camera [m]
  Eigen::Matrix3d covariance;  ///< of point_c1 [m^2]
  double residual_px = 0.0;    ///< RMS over the four pixel residuals [px]
  double angle_rad = 0.0;      ///< between the rays
};

/// Midpoint of the common perpendicular. Pixels [px] are undistorted, in the views given; sigma_px
/// is the standard deviation per pixel axis. Refuses "parallel rays", "point behind a camera",
/// "residual too large".
Outcome<TriangulatedPoint> triangulateMidpoint(const PinholeView& left, const PinholeView& right,
                                               const Eigen::Vector2d& left_px,
                                               const Eigen::Vector2d& right_px, double sigma_px,
                                               const TriangulationOptions& options = {});

/// Least reprojection error; arguments and refusals as above, and "not converged".
Outcome<TriangulatedPoint> triangulateOptimal(const PinholeView& left, const PinholeView& right,
                                              const Eigen::Vector2d& left_px,
                                              const Eigen::Vector2d& right_px, double sigma_px,
                                              const TriangulationOptions& options = {});

}  // namespace ringhook
