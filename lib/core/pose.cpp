#include "core/pose.h"

#include <Eigen/LU>
#include <cmath>

namespace ringhook {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSmallAngle = 1e-6;  // [rad]; below it the series beat the closed forms

/// Left Jacobian V of SO(3): the translation of exp(v, w) is V(w) v (Murray et al., eq. 2.36).
Matrix3d leftJacobian(const Vector3d& w) {
  const double theta = w.norm();
  const Matrix3d k = skew(w);
  if (theta < kSmallAngle) {
    return Matrix3d::Identity() + 0.5 * k + k * k / 6.0;
  }
  const double t2 = theta * theta;
  const double half_sine = std::sin(0.5 * theta);  // 1 - cos t = 2 sin^2(t/2) keeps its digits
  return Matrix3d::Identity() + 2.0 * half_sine * half_sine / t2 * k +
         (theta - std::sin(theta)) / (t2 * theta) * k * k;
}

}  // namespace

Pose makePose(const Vector3d& position, const Eigen::Quaterniond& rotation) {
  Pose aMb = Pose::Identity();
  aMb.linear() = rotation.normalized().toRotationMatrix();
  aMb.translation() = position;
  return aMb;
}

Pose makePoseThetaU(const Vector3d& position, const Vector3d& theta_u) {
  const double theta = theta_u.norm();
  Pose aMb = Pose::Identity();
  if (theta > 0.0) {
    aMb.linear() = Eigen::AngleAxisd(theta, theta_u / theta).toRotationMatrix();
  }
  aMb.translation() = position;
  return aMb;
}

Vector3d thetaU(const Matrix3d& rotation) {
  // Through the quaternion: exact near 0, where the trace formula loses half its digits.
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0.0) {
    q.coeffs() = -q.coeffs();
  }
  const double half_sine = q.vec().norm();
  if (half_sine < 1e-12) {
    return 2.0 * q.vec();
  }
  return 2.0 * std::atan2(half_sine, q.w()) / half_sine * q.vec();
}

Matrix3d skew(const Vector3d& a) {
  Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

Pose expSe3(const Twist& twist_b) {
  const Vector3d w = twist_b.tail<3>();
  return makePoseThetaU(leftJacobian(w) * twist_b.head<3>(), w);
}

Twist logSe3(const Pose& aMb) {
  Twist twist;
  const Vector3d w = thetaU(aMb.linear());
  twist << leftJacobian(w).inverse() * aMb.translation(), w;
  return twist;
}

Eigen::Matrix<double, 6, 6> twistTransform(const Pose& aMb) {
  Eigen::Matrix<double, 6, 6> aVb = Eigen::Matrix<double, 6, 6>::Zero();
  aVb.topLeftCorner<3, 3>() = aMb.linear();
  aVb.topRightCorner<3, 3>() = skew(aMb.translation()) * aMb.linear();
  aVb.bottomRightCorner<3, 3>() = aMb.linear();
  return aVb;
}

Pose interpolate(const Pose& a, const Pose& b, double s) {
  const Eigen::Quaterniond qa(a.linear());
  const Eigen::Quaterniond qb(b.linear());
  return makePose((1.0 - s) * a.translation() + s * b.translation(), qa.slerp(s, qb));
}

}  // namespace ringhook
