#include "core/pose.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>

#include "core/pinhole_view.h"
#include "core/shortest_turn.h"

namespace ringhook {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;

class PoseTest : public testing::Test {
 protected:
  Twist randomTwist(double linear, double angular) {
    Twist t;
    for (int i = 0; i < 6; ++i) {
      t[i] = (i < 3 ? linear : angular) * uniform_(random_);
    }
    return t;
  }

  std::mt19937 random_{7};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

/// The 4x4 matrix of a twist, whose matrix exponential is the motion.
Matrix4d hat(const Twist& t) {
  Matrix4d m = Matrix4d::Zero();
  m.topLeftCorner<3, 3>() = skew(t.tail<3>());
  m.topRightCorner<3, 1>() = t.head<3>();
  return m;
}

TEST_F(PoseTest, ExponentialEqualsTheMatrixExponential) {
  for (int i = 0; i < 200; ++i) {
    const Twist t = randomTwist(1.0, i % 2 == 0 ? 1.5 : 1e-4);
    const Matrix4d truth = hat(t).exp();
    EXPECT_LT((expSe3(t).matrix() - truth).norm(), 1e-12) << t.transpose();
  }
}

TEST_F(PoseTest, LogarithmUndoesTheExponential) {
  for (int i = 0; i < 200; ++i) {
    const Twist t = randomTwist(2.0, i % 3 == 0 ? 1e-7 : 1.7);
    EXPECT_LT((logSe3(expSe3(t)) - t).norm(), 1e-9) << t.transpose();
  }
}

TEST_F(PoseTest, ThetaUReachesHalfATurn) {
  const Vector3d axis = Vector3d(1, -2, 0.5).normalized();
  const Eigen::Matrix3d half = Eigen::AngleAxisd(std::numbers::pi - 1e-9, axis).toRotationMatrix();
  EXPECT_NEAR(thetaU(half).norm(), std::numbers::pi, 1e-7);
  EXPECT_NEAR(std::abs(thetaU(half).normalized().dot(axis)), 1.0, 1e-7);
}

TEST_F(PoseTest, TwistTransformCarriesVelocitiesOfARigidBody) {
  // A body moves by exp(twist_b dt) at b; frame a on the same body at aMb must move alike.
  const Pose aMb = expSe3(randomTwist(0.5, 1.0));
  const Twist twist_b = randomTwist(0.3, 0.8);
  const double dt = 1e-6;
  const Pose moved = aMb * expSe3(twist_b * dt) * aMb.inverse();
  const Twist seen_a = logSe3(moved) / dt;
  EXPECT_LT((twistTransform(aMb) * twist_b - seen_a).norm(), 1e-6);
}

TEST_F(PoseTest, InterpolationMeetsBothEndsAndTurnsEvenly) {
  const Pose a = expSe3(randomTwist(1.0, 0.5));
  const Pose b = expSe3(randomTwist(1.0, 0.5));
  EXPECT_LT((interpolate(a, b, 0.0).matrix() - a.matrix()).norm(), 1e-12);
  EXPECT_LT((interpolate(a, b, 1.0).matrix() - b.matrix()).norm(), 1e-12);
  const double whole = thetaU((a.inverse() * b).linear()).norm();
  const double quarter = thetaU((a.inverse() * interpolate(a, b, 0.25)).linear()).norm();
  EXPECT_NEAR(quarter, 0.25 * whole, 1e-12);
}

TEST_F(PoseTest, MakePoseNormalisesTheQuaternion) {
  const Pose p = makePose(Vector3d(1, 2, 3), Eigen::Quaterniond(2, 0, 0, 2));
  EXPECT_LT((p.linear() * p.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_LT((p * Vector3d::UnitX() - Vector3d(1, 3, 3)).norm(), 1e-12);
}

TEST(PinholeView, ProjectsByTheClosedFormAndRefusesPointsBehind) {
  PinholeView view;
  view.fx = 2500;
  view.fy = 2400;
  view.cx = 1000;
  view.cy = 900;
  view.cMc1.translation().x() = -0.4;
  const auto pixel = view.project(Vector3d(0.5, 0.2, 2.0));
  ASSERT_TRUE(pixel.has_value());
  EXPECT_NEAR(pixel->x(), 2500 * 0.1 / 2.0 + 1000, 1e-9);
  EXPECT_NEAR(pixel->y(), 2400 * 0.2 / 2.0 + 900, 1e-9);
  EXPECT_FALSE(view.project(Vector3d(0, 0, -1)).has_value());
  EXPECT_FALSE(view.project(Vector3d(0, 0, 0)).has_value());
}

TEST(ShortestTurn, TurnsOneDirectionIntoAnotherAcrossBoth) {
  const Eigen::Vector3d from(0.2, -0.1, 2.0);
  const Eigen::Vector3d to(-3.0, 0.5, 0.3);
  const Eigen::Quaterniond turn = shortestTurn(from, to);
  EXPECT_NEAR(turn.norm(), 1.0, 1e-14);
  EXPECT_LT((turn * from.normalized() - to.normalized()).norm(), 1e-14);
  const Eigen::Vector3d theta_u = thetaU(turn.toRotationMatrix());
  EXPECT_NEAR(theta_u.dot(from), 0.0, 1e-14);
  EXPECT_NEAR(theta_u.norm(), std::acos(from.normalized().dot(to.normalized())), 1e-14);
  EXPECT_TRUE(shortestTurn(from, 3.0 * from).isApprox(Eigen::Quaterniond::Identity(), 1e-14));
}

TEST(ShortestTurn, IsHalfATurnBetweenOppositeDirections) {
  for (const double off : {0.0, 1e-9, 1e-7, 1e-5, 1e-3}) {
    const Eigen::Vector3d from(0.2, -0.1, 2.0);
    const Eigen::Vector3d to = -from + off * Eigen::Vector3d::UnitX();
    const Eigen::Quaterniond turn = shortestTurn(from, to);
    EXPECT_NEAR(turn.norm(), 1.0, 1e-14) << off;
    EXPECT_LT((turn * from.normalized() - to.normalized()).norm(), 1e-8) << off;
  }
}

}  // namespace
}  // namespace ringhook
