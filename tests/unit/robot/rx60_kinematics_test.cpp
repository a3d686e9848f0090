#include "core/angle.h"
#include "robot/rx60/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "joint_samples.h"

namespace ringhook::rx60 {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

/// The arm built from its drawing, without any table: turn, climb, lean, walk, lean, walk, ...
Pose forwardFromDrawing(const Geometry& g, const JointVector& q) {
  Pose pose = Pose::Identity();
  pose.rotate(AngleAxisd(q(0), Vector3d::UnitZ()));
  pose.translate(Vector3d(0.0, g.shoulder_offset, g.base_height));
  pose.rotate(AngleAxisd(q(1), Vector3d::UnitY()));
  pose.translate(Vector3d(0.0, 0.0, g.upper_arm));
  pose.rotate(AngleAxisd(q(2), Vector3d::UnitY()));
  pose.rotate(AngleAxisd(q(3), Vector3d::UnitZ()));
  pose.translate(Vector3d(0.0, 0.0, g.forearm));
  pose.rotate(AngleAxisd(q(4), Vector3d::UnitY()));
  pose.translate(Vector3d(0.0, 0.0, g.flange));
  pose.rotate(AngleAxisd(q(5), Vector3d::UnitZ()));
  return pose;
}

TEST(Rx60Forward, StandsStraightUpAtZero) {
  const Pose fMe = forward(rx60(), JointVector::Zero());
  EXPECT_TRUE(fMe.translation().isApprox(Vector3d(0.0, 0.049, 1.006), 1e-15));
  EXPECT_TRUE(fMe.linear().isIdentity(1e-15));
  EXPECT_NEAR(forward(rx60L(), JointVector::Zero()).translation().z(), 1.206, 1e-15);
}

TEST(Rx60Forward, LeansForwardsWithJoint2) {
  JointVector q = JointVector::Zero();
  q(1) = std::numbers::pi / 2.0;
  const Pose fMe = forward(rx60(), q);
  EXPECT_TRUE(fMe.translation().isApprox(Vector3d(0.665, 0.049, 0.341), 1e-14));
  EXPECT_TRUE(fMe.linear().col(2).isApprox(Vector3d::UnitX(), 1e-14));
}

TEST(Rx60Forward, AgreesWithTheArmsDrawing) {
  JointSamples samples(1);
  for (int i = 0; i < 10000; ++i) {
    const JointVector q = samples.within(limits());
    EXPECT_TRUE(forward(rx60(), q).isApprox(forwardFromDrawing(rx60(), q), 1e-14)) << q.transpose();
    EXPECT_TRUE(forward(rx60L(), q).isApprox(forwardFromDrawing(rx60L(), q), 1e-14));
  }
}

TEST(Rx60Jacobian, AgreesWithCentralDifferences) {
  constexpr double kStep = 1e-5;  // [rad]
  JointSamples samples(2);
  double worst = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const JointVector q = samples.within(limits());
    const Jacobian fJe = jacobian(rx60(), q);
    for (int joint = 0; joint < 6; ++joint) {
      JointVector before = q;
      JointVector after = q;
      before(joint) -= kStep;
      after(joint) += kStep;
      const Pose fMa = forward(rx60(), before);
      const Pose fMb = forward(rx60(), after);
      Twist difference;
      difference << fMb.translation() - fMa.translation(),
          thetaU(fMb.linear() * fMa.linear().transpose());
      worst = std::max(worst, (difference / (2.0 * kStep) - fJe.col(joint)).norm());
    }
  }
  EXPECT_LT(worst, 1e-6);
  RecordProperty("worst", std::to_string(worst));
}

TEST(Rx60Jacobian, HasTheClosedFormDeterminant) {
  // |det J| of a spherical-wrist arm of this shape: L2 L4 |sin q3| |rr| |sin q5|.
  const Geometry g = rx60();
  JointSamples samples(3);
  for (int i = 0; i < 1000; ++i) {
    const JointVector q = samples.within(limits());
    const double rr = g.upper_arm * std::sin(q(1)) + g.forearm * std::sin(q(1) + q(2));
    const double expected =
        std::abs(g.upper_arm * g.forearm * std::sin(q(2)) * rr * std::sin(q(4)));
    EXPECT_NEAR(std::abs(jacobian(g, q).determinant()), expected, 1e-14);
  }
}

TEST(Rx60LinkPoints, KeepTheLengthsOfTheArm) {
  const Geometry g = rx60();
  JointSamples samples(4);
  for (int i = 0; i < 1000; ++i) {
    const JointVector q = samples.within(limits());
    const LinkPoints p = linkPoints(g, q);
    EXPECT_NEAR((p.shoulder - p.base).norm(), g.base_height, 1e-14);
    EXPECT_NEAR((p.upper_arm - p.shoulder).norm(), g.shoulder_offset, 1e-14);
    EXPECT_NEAR((p.elbow - p.upper_arm).norm(), g.upper_arm, 1e-14);
    EXPECT_NEAR((p.wrist - p.elbow).norm(), g.forearm, 1e-14);
    EXPECT_NEAR((p.flange - p.wrist).norm(), g.flange, 1e-14);
    EXPECT_TRUE(p.flange.isApprox(forward(g, q).translation(), 1e-14));
  }
}

TEST(Rx60Limits, AreThePublishedOnes) {
  const JointLimits published = limits();
  EXPECT_NEAR(published.upper(0), 160.0 * kDegree, 1e-12);
  EXPECT_NEAR(published.lower(4), -109.5 * kDegree, 1e-12);
  EXPECT_NEAR(published.upper(4), 120.5 * kDegree, 1e-12);
  EXPECT_NEAR(published.velocity(5), 700.0 * kDegree, 1e-12);
  EXPECT_TRUE((published.acceleration.array() > 0.0).all());
}

}  // namespace
}  // namespace ringhook::rx60
