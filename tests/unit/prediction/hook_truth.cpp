#include "hook_truth.h"

#include <cmath>
#include <numbers>

namespace ringhook {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;  // u, u'

Vector6 slope(const HookTruthOptions& o, const Vector6& s) {
  const Eigen::Vector3d u = s.head<3>();
  const Eigen::Vector3d w = s.tail<3>();
  const Eigen::Vector3d pull(0.0, 0.0, -9.81 / o.length);
  Vector6 d;
  d << w,
      -w.squaredNorm() * u + pull - u * u.dot(pull) - o.viscous * w - o.dry * w / (w.norm() + 1e-3);
  return d;
}

Vector6 rk4(const HookTruthOptions& o, const Vector6& s, double h) {
  const Vector6 k1 = slope(o, s);
  const Vector6 k2 = slope(o, s + 0.5 * h * k1);
  const Vector6 k3 = slope(o, s + 0.5 * h * k2);
  const Vector6 k4 = slope(o, s + h * k3);
  Vector6 next = s + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  next.head<3>().normalize();
  return next;
}

// Suspension that turns about y first and x second, the other order than the filter's.
Pose poseOf(const HookTruthOptions& o, const Eigen::Vector3d& u, double time) {
  const double y = std::atan2(-u.x(), -u.z());
  const double x = std::asin(u.y());
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(y, Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(x + o.tilt_x, Eigen::Vector3d::UnitX()) *
                             Eigen::AngleAxisd(o.tilt_y, Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(o.yaw, Eigen::Vector3d::UnitZ()))
                                .toRotationMatrix();
  Pose fMo = Pose::Identity();
  fMo.linear() = R;
  fMo.translation() = Eigen::Vector3d(0.42, -0.3 + o.belt_speed * time, 1.05) - R * o.pivot_o;
  return fMo;
}

}  // namespace

std::vector<Pose> simulateHook(const HookTruthOptions& o, double step, int count) {
  const double w = std::sqrt(9.81 / o.length);
  Vector6 state;
  state << o.swing * std::cos(o.phase), o.swing * std::sin(o.phase), -1.0,
      -o.swing * w * std::sin(o.phase), o.swing * w * std::cos(o.phase), 0.0;
  state.head<3>().normalize();
  state.tail<3>() -= state.head<3>() * state.head<3>().dot(state.tail<3>());
  const int parts = static_cast<int>(std::ceil(step / 1e-3));
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    poses.push_back(poseOf(o, state.head<3>(), i * step));
    for (int part = 0; part < parts; ++part) {
      state = rk4(o, state, step / parts);
    }
  }
  return poses;
}

HookFix noisyFix(const HookTruthOptions& o, const Pose& fMc1, const Pose& fMo, double time_s,
                 std::mt19937& random) {
  std::normal_distribution<double> normal;
  Twist sigma;
  sigma << Eigen::Vector3d::Constant(o.position_sigma), Eigen::Vector3d::Constant(o.rotation_sigma);
  const Twist d = sigma.cwiseProduct(Twist::NullaryExpr([&] { return normal(random); }));
  HookFix fix;
  fix.time = Time::fromSeconds(time_s);
  fix.c1Mo = fMc1.inverse() * fMo * expSe3(d);
  fix.covariance = sigma.cwiseAbs2().asDiagonal();
  return fix;
}

Pose testCamera() {
  Eigen::Matrix3d R;
  R << 0, 0, -1, 1, 0, 0, 0, -1, 0;  // looks along -x of f, rows down
  Pose fMc1 = Pose::Identity();
  fMc1.linear() = R;
  fMc1.translation() << 1.75, -0.2, 0.7;
  return fMc1;
}

}  // namespace ringhook
