#include "prediction/hanging_pose.h"

#include <gtest/gtest.h>

#include <random>

namespace ringhook {
namespace {

const Eigen::Vector3d kPivot(0.0, -0.02, 0.45);

TEST(HangingPose, ComesBackExactlyForAnyPoseBelowTheHorizon) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1.2, 1.2);
  for (int i = 0; i < 1000; ++i) {
    const HangingPose there{
        {any(random), any(random), any(random)}, any(random), any(random), 2.0 * any(random)};
    const Pose fMo = poseFromHanging(there, kPivot);
    const HangingPose back = hangingFromPose(fMo, kPivot);
    ASSERT_TRUE(back.pivot_f.isApprox(there.pivot_f, 1e-12));
    ASSERT_NEAR(back.swing_x, there.swing_x, 1e-12);
    ASSERT_NEAR(back.swing_y, there.swing_y, 1e-12);
    ASSERT_NEAR(back.yaw, there.yaw, 1e-12);
    ASSERT_TRUE(poseFromHanging(back, kPivot).isApprox(fMo, 1e-12));
  }
}

TEST(HangingPose, PutsTheHookBelowThePivotAndTheShankAlongItsDirection) {
  HangingPose hanging{{0.42, 0.1, 1.05}, 0.2, 0.0, 0.0};
  const Pose fMo = poseFromHanging(hanging, {0.0, 0.0, 0.45});
  // Turned about +x by 0.2 the shank's lower end moves towards +y.
  const Eigen::Vector3d expected(0.42, 0.1 + 0.45 * std::sin(0.2), 1.05 - 0.45 * std::cos(0.2));
  EXPECT_TRUE(fMo.translation().isApprox(expected, 1e-12));
}

// Truth: differences through the exponential, which the Jacobian does not use.
TEST(HangingPose, JacobianAndTwistAgreeWithDifferences) {
  const HangingPose at{{0.4, -0.1, 1.0}, 0.15, -0.2, 0.3};
  const Pose fMo = poseFromHanging(at, kPivot);
  const auto J = hangingJacobian(at, kPivot);
  const double h = 1e-6;
  for (int i = 0; i < 6; ++i) {
    HangingPose moved = at;
    double* const parts[] = {&moved.pivot_f.x(), &moved.pivot_f.y(), &moved.pivot_f.z(),
                             &moved.swing_x,     &moved.swing_y,     &moved.yaw};
    *parts[i] += h;
    const Twist d = logSe3(fMo.inverse() * poseFromHanging(moved, kPivot)) / h;
    EXPECT_TRUE(d.isApprox(J.col(i), 1e-5)) << i;
  }
  const Eigen::Vector3d velocity(0.01, 0.2, 0.03);
  const Eigen::Vector3d rates(0.4, -0.5, 0.6);
  HangingPose later = at;
  later.pivot_f += h * velocity;
  later.swing_x += h * rates.x();
  later.swing_y += h * rates.y();
  later.yaw += h * rates.z();
  const Pose moved = poseFromHanging(later, kPivot);
  const Twist twist_f = hangingTwist(at, kPivot, velocity, rates);
  EXPECT_TRUE(((moved.translation() - fMo.translation()) / h).isApprox(twist_f.head<3>(), 1e-5));
  EXPECT_TRUE(
      (thetaU(moved.linear() * fMo.linear().transpose()) / h).isApprox(twist_f.tail<3>(), 1e-5));
}

}  // namespace
}  // namespace ringhook
