#include "calib/solve/stereo_uncertainty.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ringhook {
namespace {

using Parameters = Eigen::Matrix<double, 30, 1>;

Parameters parametersOf(const StereoRig& rig) {
  Parameters p = Parameters::Zero();
  int at = 0;
  for (const CameraModel* camera : {&rig.left, &*rig.right}) {
    p.segment<4>(at) << camera->K(0, 0), camera->K(1, 1), camera->K(0, 2), camera->K(1, 2);
    p.segment(at + 4, camera->distortion.size()) = camera->distortion;
    at += 12;
  }
  p.segment<3>(24) = thetaU(rig.c2Mc1.linear());
  p.segment<3>(27) = rig.c2Mc1.translation();
  return p;
}

StereoRig rigOf(const Parameters& p, StereoRig rig) {
  int at = 0;
  for (CameraModel* camera : {&rig.left, &*rig.right}) {
    camera->K << p[at], 0, p[at + 2], 0, p[at + 1], p[at + 3], 0, 0, 1;
    camera->distortion = p.segment(at + 4, camera->distortion.size());
    at += 12;
  }
  rig.c2Mc1 = makePoseThetaU(p.segment<3>(27), p.segment<3>(24));
  return rig;
}

// Midpoint of the shortest segment between the rays of two pixels, in c1 [m].
Eigen::Vector3d triangulated(const StereoRig& rig, const Eigen::Vector2d& left,
                             const Eigen::Vector2d& right) {
  const auto ray1 = undistortPixel(rig.left, left);
  const auto ray2 = undistortPixel(*rig.right, right);
  if (!ray1 || !ray2) {
    return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  const Pose c1Mc2 = rig.c2Mc1.inverse();
  const Eigen::Vector3d a = ray1->homogeneous();
  const Eigen::Vector3d b = c1Mc2.linear() * ray2->homogeneous();
  const Eigen::Vector3d c = c1Mc2.translation();
  const double det = a.squaredNorm() * b.squaredNorm() - std::pow(a.dot(b), 2);
  const double s = (a.dot(c) * b.squaredNorm() - b.dot(c) * a.dot(b)) / det;
  const double t = (a.dot(c) * a.dot(b) - b.dot(c) * a.squaredNorm()) / det;
  return 0.5 * (s * a + c + t * b);
}

// The reference point: on the bisector of the optical axes, from the middle of the baseline.
Eigen::Vector3d referencePoint(const StereoRig& rig) {
  const Pose c1Mc2 = rig.c2Mc1.inverse();
  const Eigen::Vector3d ahead = (Eigen::Vector3d::UnitZ() + c1Mc2.linear().col(2)).normalized();
  return 0.5 * c1Mc2.translation() + kTypicalDistance_m * ahead;
}

Eigen::Vector3d positionSigma(const StereoRig& rig, const RigCovariance& covariance) {
  const Eigen::Vector3d point = referencePoint(rig);
  const Eigen::Vector2d left = projectNormalised(rig.left, point.hnormalized());
  const Eigen::Vector2d right =
      projectNormalised(*rig.right, (rig.c2Mc1 * point).eval().hnormalized());
  const Parameters p = parametersOf(rig);
  Eigen::Matrix<double, 3, 30> J = Eigen::Matrix<double, 3, 30>::Zero();
  for (int i = 0; i < 30; ++i) {
    if (!(covariance(i, i) > 0.0)) {
      continue;
    }
    const double step = 0.1 * std::sqrt(covariance(i, i));
    Parameters more = p;
    Parameters less = p;
    more[i] += step;
    less[i] -= step;
    J.col(i) = (triangulated(rigOf(more, rig), left, right) -
                triangulated(rigOf(less, rig), left, right)) /
               (2.0 * step);
  }
  return (J * covariance * J.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
}

LensSigma lensSigma(const Parameters& sigma, int at, const CameraModel& camera) {
  return {sigma.segment<2>(at), sigma.segment<2>(at + 2),
          sigma.segment(at + 4, camera.distortion.size())};
}

}  // namespace

Uncertainty uncertaintyOf(const StereoRig& rig, const RigCovariance& covariance, double sigma_px) {
  const Parameters sigma = sigma_px * covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  Uncertainty u;
  u.left = lensSigma(sigma, 0, rig.left);
  u.right = lensSigma(sigma, 12, *rig.right);
  u.rotation_rad = sigma.segment<3>(24);
  u.translation_m = sigma.segment<3>(27);
  const Eigen::Vector3d along = rig.c2Mc1.translation().normalized();
  u.baseline_m =
      sigma_px * std::sqrt(std::max(0.0, along.dot(covariance.bottomRightCorner<3, 3>() * along)));
  u.focal_px = std::max(u.left.focal_px.maxCoeff(), u.right.focal_px.maxCoeff());
  u.position_m = sigma_px * positionSigma(rig, covariance);
  return u;
}

}  // namespace ringhook
