#pragma once

/// \file
/// Projection into an ideal view with its derivative:
/// d(u, v)/dp_c1 = [fx/Z 0 -fx X/Z^2; 0 fy/Z -fy Y/Z^2] R, R the rotation of cMc1.

#include <Eigen/Core>
#include <optional>

#include "core/pinhole_view.h"

namespace ringhook {

struct Projection {
  Eigen::Vector2d pixel;                 ///< [px]
  Eigen::Matrix<double, 2, 3> jacobian;  ///< of the pixel by the point in c1 [px/m]
};

/// Nothing for a point (in c1 [m]) that is not in front of the camera.
std::optional<Projection> projectWithJacobian(const PinholeView& view,
                                              const Eigen::Vector3d& point_c1);

}  // namespace ringhook
