#include "prediction/hanging_pose.h"

#include <cmath>

namespace ringhook {
namespace {

Eigen::Matrix3d swingRotation(const HangingPose& hanging) {
  return (Eigen::AngleAxisd(hanging.swing_x, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(hanging.swing_y, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

Eigen::Matrix3d rotation(const HangingPose& hanging) {
  return swingRotation(hanging) * Eigen::AngleAxisd(hanging.yaw, Eigen::Vector3d::UnitZ());
}

// Columns: the axes of the three angle rates, in f.
Eigen::Matrix3d rateAxes(const HangingPose& hanging) {
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d::UnitX();
  axes.col(1) = Eigen::Vector3d(0.0, std::cos(hanging.swing_x), std::sin(hanging.swing_x));
  axes.col(2) = swingRotation(hanging).col(2);
  return axes;
}

}  // namespace

HangingPose hangingFromPose(const Pose& fMo, const Eigen::Vector3d& pivot_o) {
  const Eigen::Vector3d u = -fMo.linear().col(2);
  HangingPose hanging;
  hanging.pivot_f = fMo * pivot_o;
  hanging.swing_x = std::atan2(u.y(), -u.z());
  hanging.swing_y = std::atan2(-u.x(), std::hypot(u.y(), u.z()));
  const Eigen::Matrix3d left = swingRotation(hanging).transpose() * fMo.linear();
  hanging.yaw = std::atan2(left(1, 0), left(0, 0));
  return hanging;
}

Pose poseFromHanging(const HangingPose& hanging, const Eigen::Vector3d& pivot_o) {
  Pose fMo = Pose::Identity();
  fMo.linear() = rotation(hanging);
  fMo.translation() = hanging.pivot_f - fMo.linear() * pivot_o;
  return fMo;
}

Eigen::Matrix<double, 6, 6> hangingJacobian(const HangingPose& hanging,
                                            const Eigen::Vector3d& pivot_o) {
  const Eigen::Matrix3d oRf = rotation(hanging).transpose();
  const Eigen::Matrix3d G = oRf * rateAxes(hanging);
  Eigen::Matrix<double, 6, 6> J;
  J << oRf, skew(pivot_o) * G, Eigen::Matrix3d::Zero(), G;
  return J;
}

Twist hangingTwist(const HangingPose& hanging, const Eigen::Vector3d& pivot_o,
                   const Eigen::Vector3d& pivot_velocity_f, const Eigen::Vector3d& angle_rates) {
  const Eigen::Vector3d omega_f = rateAxes(hanging) * angle_rates;
  Twist twist_f;
  twist_f << pivot_velocity_f - omega_f.cross(rotation(hanging) * pivot_o), omega_f;
  return twist_f;
}

}  // namespace ringhook
