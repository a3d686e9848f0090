#pragma once

/// \file
/// Plane through points by total least squares: the normal is the direction of least scatter about
/// the centroid, the last eigenvector of the scatter matrix (Pearson 1901).

#include <Eigen/Core>
#include <vector>

#include "core/outcome.h"

namespace ringhook {

struct Plane {
  Eigen::Vector3d centroid;  ///< of the points, in their frame [m]
  Eigen::Matrix3d axes;      ///< columns: largest and second scatter, normal; right-handed
  double rms = 0.0;          ///< distance of the points from the plane [m]

  [[nodiscard]] Eigen::Vector3d normal() const { return axes.col(2); }
};

/// Refuses "fewer than three points" and "points on one line" (second scatter below 1e-3 of the
/// first). The sign of the normal is arbitrary.
Outcome<Plane> fitPlane(const std::vector<Eigen::Vector3d>& points);

}  // namespace ringhook
