#include "stereo/epipolar.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "core/error.h"

namespace ringhook {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Matrix3d cameraMatrix(const PinholeView& view) {
  Matrix3d K;
  K << view.fx, 0.0, view.cx, 0.0, view.fy, view.cy, 0.0, 0.0, 1.0;
  return K;
}

Vector3d normalisedLine(const Vector3d& line) { return line / line.head<2>().norm(); }

}  // namespace

Matrix3d essentialMatrix(const Pose& c2Mc1) { return skew(c2Mc1.translation()) * c2Mc1.linear(); }

Matrix3d fundamentalMatrix(const Matrix3d& K1, const Matrix3d& K2, const Pose& c2Mc1) {
  const Matrix3d F = K2.inverse().transpose() * essentialMatrix(c2Mc1) * K1.inverse();
  return F / F.norm();
}

Matrix3d fundamentalMatrix(const StereoRig& rig) {
  if (!rig.right) {
    throw InputError("the rig has one camera: epipolar geometry needs K2, D2, R and T");
  }
  return fundamentalMatrix(rig.left.K, rig.right->K, rig.c2Mc1);
}

Matrix3d fundamentalMatrix(const PinholeView& left, const PinholeView& right) {
  return fundamentalMatrix(cameraMatrix(left), cameraMatrix(right),
                           right.cMc1 * left.cMc1.inverse());
}

Vector3d epipolarLineInRight(const Matrix3d& F, const Vector2d& left_px) {
  return normalisedLine(F * left_px.homogeneous());
}

Vector3d epipolarLineInLeft(const Matrix3d& F, const Vector2d& right_px) {
  return normalisedLine(F.transpose() * right_px.homogeneous());
}

Epipoles epipoles(const Matrix3d& F) {
  const Eigen::JacobiSVD<Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixV().col(2), svd.matrixU().col(2)};
}

double symmetricEpipolarDistance(const Matrix3d& F, const Vector2d& left_px,
                                 const Vector2d& right_px) {
  const double in_right = epipolarLineInRight(F, left_px).dot(right_px.homogeneous());
  const double in_left = epipolarLineInLeft(F, right_px).dot(left_px.homogeneous());
  return std::sqrt(0.5 * (in_right * in_right + in_left * in_left));
}

}  // namespace ringhook
