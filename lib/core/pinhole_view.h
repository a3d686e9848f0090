#pragma once

/// \file
/// One ideal pinhole camera: undistorted (and possibly rectified) pixel coordinates, and where
/// that camera stands relative to the left one. Law: u = fx X/Z + cx, v = fy Y/Z + cy
/// (Hartley and Zisserman, "Multiple View Geometry", 2nd ed., eq. 6.8, no skew).

#include <Eigen/Core>
#include <optional>

#include "core/pose.h"

namespace ringhook {

struct PinholeView {
  double fx = 1.0;               ///< focal length along u [px]
  double fy = 1.0;               ///< focal length along v [px]
  double cx = 0.0;               ///< principal point, u [px]
  double cy = 0.0;               ///< principal point, v [px]
  int width = 0;                 ///< of the full image [px]
  int height = 0;                ///< of the full image [px]
  Pose cMc1 = Pose::Identity();  ///< left camera in this camera; a pure rotation for left itself

  /// Pixel of a point given in c1 [m]; nothing if it lies behind this camera.
  [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_c1) const {
    const Eigen::Vector3d p = cMc1 * point_c1;
    if (!(p.z() > 0.0)) {
      return std::nullopt;
    }
    return Eigen::Vector2d(fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy);
  }
};

}  // namespace ringhook
