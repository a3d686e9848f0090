#pragma once

/// \file
/// Ideal camera pairs and what they see of the hook's tag plate.

#include <cmath>
#include <random>
#include <vector>

#include "core/hook_values.h"

namespace ringhook::test {

/// Two cameras `baseline_m` apart, each turned by `verge_rad` towards the other; f = 2500 px.
inline std::vector<PinholeView> pairOfViews(double baseline_m, double verge_rad) {
  PinholeView left;
  left.fx = left.fy = 2500.0;
  left.cx = left.cy = 1023.5;
  left.width = left.height = 2048;
  PinholeView right = left;
  right.cMc1 = makePoseThetaU({0, 0, 0}, {0, 2.0 * verge_rad, 0});
  right.cMc1.translation() =
      -(right.cMc1.linear() *
        Eigen::Vector3d(baseline_m * std::cos(verge_rad), 0, baseline_m * std::sin(verge_rad)));
  return {left, right};
}

/// Eight corners of two 40 mm tags, one 54 mm above the other.
inline std::vector<Eigen::Vector3d> plateCorners() {
  std::vector<Eigen::Vector3d> corners;
  for (const double y : {0.027, -0.027}) {
    for (const auto& [dx, dy] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      corners.emplace_back(0.02 * dx, y + 0.02 * dy, 0.0);
    }
  }
  return corners;
}

/// The corners as both cameras see them at c1Mo, with Gaussian noise [px].
inline HookView seenPlate(const std::vector<PinholeView>& cameras, const Pose& c1Mo,
                          double noise_px, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  HookView view;
  view.c1Mo_start = c1Mo;
  for (const PinholeView& camera : cameras) {
    CameraFeatures features{camera, {}, {}};
    for (const Eigen::Vector3d& p : plateCorners()) {
      const Eigen::Vector2d error(noise_px * noise(random), noise_px * noise(random));
      features.corners.push_back({p, *camera.project(c1Mo * p) + error, 0.1});
    }
    view.cameras.push_back(features);
  }
  return view;
}

inline Pose samplePose() { return makePoseThetaU({0.17, 0.05, 1.3}, {0.25, -0.3, 0.1}); }

}  // namespace ringhook::test
