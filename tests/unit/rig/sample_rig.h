#pragma once

/// \file
/// A verged pair with real lenses, as in the default cell: 0.4 m apart, looking at one point 1.3 m
/// away, f about 2500 px scaled to the image size.

#include <cmath>

#include "rig/stereo_rig.h"

namespace ringhook::test {

inline CameraModel sampleCamera(int size_px, int coefficients) {
  CameraModel camera;
  camera.width = size_px;
  camera.height = size_px - 48;
  const double f = 1.22 * size_px;
  camera.K << f, 0, 0.503 * size_px, 0, 1.002 * f, 0.491 * size_px, 0, 0, 1;
  Eigen::VectorXd all(8);
  all << -0.12, 0.09, 4e-4, -3e-4, 0.02, 0.01, -0.015, 0.004;
  camera.distortion = all.head(coefficients);
  return camera;
}

inline StereoRig sampleRig(int size_px = 512, int coefficients = 5) {
  StereoRig rig;
  rig.left = sampleCamera(size_px, coefficients);
  rig.right = sampleCamera(size_px, coefficients);
  rig.right->K(0, 0) *= 1.01;
  rig.right->K(1, 2) += 7.0;
  const double half = std::atan2(0.2, 1.3);
  rig.c2Mc1 = makePoseThetaU({0, 0, 0}, {0.006, 2.0 * half, -0.01});
  rig.c2Mc1.translation() =
      -(rig.c2Mc1.linear() * Eigen::Vector3d(0.4 * std::cos(half), 0.004, 0.4 * std::sin(half)));
  return rig;
}

}  // namespace ringhook::test
