#include "moving_hook.h"

#include <cmath>

namespace ringhook::test {

Pose MovingHook::at(const CellConfig& cell, Time time) const {
  const double s = time.seconds();
  const double phase = std::sqrt(9.81 / cell.hook.pendulum_length_m) * s;
  const Eigen::Vector3d pivot_f =
      cell.belt.pivot_start_f + (travel_m + speed_m_s * s) * cell.belt.direction_f;
  Pose fMo = Pose::Identity();
  fMo.linear() = (Eigen::AngleAxisd(swing_rad * std::sin(phase), Eigen::Vector3d::UnitX()) *
                  Eigen::AngleAxisd(0.6 * swing_rad * std::cos(phase), Eigen::Vector3d::UnitY()))
                     .toRotationMatrix();
  fMo.translation() = pivot_f - fMo.linear() * cell.hook.pivot_o;
  return fMo;
}

HookFix MovingHook::fix(const CellConfig& cell, const Pose& fMc1, Time time) const {
  HookFix fix;
  fix.time = time;
  fix.c1Mo = fMc1.inverse() * at(cell, time);
  Twist variance;
  variance << Eigen::Vector3d::Constant(1e-8), Eigen::Vector3d::Constant(1e-6);
  fix.covariance = variance.asDiagonal();
  return fix;
}

}  // namespace ringhook::test
