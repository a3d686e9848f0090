#include "measured_by_rig.h"

#include "core/error.h"
#include "stereo/triangulation.h"

namespace ringhook::test {
namespace {

constexpr double kPlane_px = 2500.0;  // scale of undistorted pixels
constexpr double kSigma_px = 0.05;

}  // namespace

Eigen::Vector2d imageOf(const CameraModel& camera, const Eigen::Vector3d& point_c) {
  return projectNormalised(camera, point_c.hnormalized());
}

Eigen::Vector3d triangulatedBy(const StereoRig& rig, const Eigen::Vector2d& left,
                               const Eigen::Vector2d& right) {
  const auto ray1 = undistortPixel(rig.left, left);
  const auto ray2 = undistortPixel(*rig.right, right);
  if (!ray1 || !ray2) {
    throw Error("a point lies beyond the lens model");
  }
  PinholeView one;
  one.fx = one.fy = kPlane_px;
  PinholeView two = one;
  two.cMc1 = rig.c2Mc1;
  const auto point = triangulateOptimal(one, two, kPlane_px * *ray1, kPlane_px * *ray2, kSigma_px);
  if (!point) {
    throw Error("a point cannot be triangulated: " + point.reason());
  }
  return point->point_c1;
}

Eigen::Vector3d measuredBy(const StereoRig& rig, const StereoRig& truth,
                           const Eigen::Vector3d& point_c1) {
  return triangulatedBy(rig, imageOf(truth.left, point_c1),
                        imageOf(*truth.right, truth.c2Mc1 * point_c1));
}

}  // namespace ringhook::test
