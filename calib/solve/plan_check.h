#pragma once

/// \file
/// A plan's predictions against repeated measurement: points are projected, noise is added to their
/// raw pixels, and the project's own undistortion and triangulation measure them again.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "calib/solve/plan.h"

namespace ringhook {

struct CheckedPoint {
  Eigen::Vector3d point_m;   ///< in frame m [m]
  double predicted_m = 0.0;  ///< square root of the covariance's trace [m]
  double measured_m = 0.0;   ///< RMS distance of the measurements from the point [m]
  int refused = 0;           ///< measurements that triangulation refused
};

/// `draws` measurements of every point, Gaussian noise of sigma_px per axis [px]. Precondition:
/// both cameras see every point.
std::vector<CheckedPoint> checkPlan(const PlanView& view,
                                    const std::vector<Eigen::Vector3d>& points_m, double sigma_px,
                                    int draws, std::uint64_t seed);

/// Largest |measured / predicted - 1|; infinity if a measurement was refused.
double largestDisagreement(const std::vector<CheckedPoint>& points);

}  // namespace ringhook
