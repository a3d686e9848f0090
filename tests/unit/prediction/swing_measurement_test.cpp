#include "prediction/swing_measurement.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "swing_trial.h"

namespace ringhook {
namespace {

constexpr SwingSight kSights[] = {SwingSight::kPose, SwingSight::kPoint, SwingSight::kPointAndPivot,
                                  SwingSight::kOneAngle, SwingSight::kTwoAngles};
const Eigen::Vector3d kPivot(0.01, -0.02, 0.45);

/// What `sight` shows of a state, with covariance 1e-4.
SwingMeasurement seen(const SwingVector& state, SwingSight sight) {
  SwingMeasurement m;
  m.sight = sight;
  m.fMo = swingPose(state, kPivot);
  m.value = expectedSwingValue(state, sight, kPivot);
  const int size = swingSightSize(sight);
  m.covariance = 1e-4 * SwingValueCovariance::Identity(size, size);
  return m;
}

SwingBelief anyBelief() {
  SwingMatrix root;
  for (int i = 0; i < root.size(); ++i) {
    root(i / kSwingStates, i % kSwingStates) = 0.02 * std::sin(12.9 * i);
  }
  return {anyState(), root * root.transpose() + 1e-4 * SwingMatrix::Identity()};
}

TEST(SwingMeasurement, WhatIsExpectedLeavesNoResidual) {
  for (const SwingSight sight : kSights) {
    const auto innovation = swingInnovation(anyState(), seen(anyState(), sight), kPivot);
    EXPECT_EQ(innovation.residual.size(), swingSightSize(sight));
    EXPECT_LT(innovation.residual.norm(), 1e-12);
  }
}

TEST(SwingMeasurement, EverySightsJacobianIsItsDerivative) {
  constexpr double kStep = 1e-6;
  for (const SwingSight sight : kSights) {
    const SwingValueJacobian H = swingInnovation(anyState(), seen(anyState(), sight), kPivot).H;
    for (int i = 0; i < kSwingStates; ++i) {
      SwingVector above = anyState();
      SwingVector below = anyState();
      above(i) += kStep;
      below(i) -= kStep;
      const SwingValue up = swingInnovation(anyState(), seen(above, sight), kPivot).residual;
      const SwingValue down = swingInnovation(anyState(), seen(below, sight), kPivot).residual;
      EXPECT_LT((H.col(i) - (up - down) / (2.0 * kStep)).cwiseAbs().maxCoeff(), 1e-8)
          << "sight " << static_cast<int>(sight) << ", state " << i;
    }
  }
}

TEST(SwingMeasurement, TheTwistIsThePosesVelocity) {
  constexpr double kStep = 1e-6;
  SwingVector later = anyState();
  SwingVector before = anyState();
  for (const auto& [state, sign] : {std::pair{&later, 1.0}, std::pair{&before, -1.0}}) {
    state->segment<3>(kSwingPivot) += sign * kStep * anyState().segment<3>(kSwingSpeed);
    state->segment<2>(kSwingAngle) += sign * kStep * anyState().segment<2>(kSwingRate);
  }
  const Eigen::Vector3d velocity =
      (swingPose(later, kPivot).translation() - swingPose(before, kPivot).translation()) /
      (2.0 * kStep);
  const Twist twist = swingTwist(anyState(), kPivot);
  EXPECT_LT((twist.head<3>() - velocity).norm(), 1e-8);
}

// Gauss and Laplace's least squares in information form: P+^-1 = P^-1 + H^T R^-1 H.
TEST(SwingMeasurement, ACorrectionIsTheInformationFormsToo) {
  const SwingBelief belief = anyBelief();
  for (const SwingSight sight : kSights) {
    SwingVector truth = anyState();
    truth.segment<4>(kSwingAngle) += Eigen::Vector4d(0.01, -0.02, 0.1, 0.1);
    const SwingMeasurement m = seen(truth, sight);
    const SwingInnovation in = swingInnovation(belief.mean, m, kPivot);
    const SwingCorrection correction = correctSwing(belief, m, kPivot);
    const Eigen::MatrixXd H = in.H;
    const Eigen::MatrixXd S = H * belief.covariance * H.transpose() + Eigen::MatrixXd(m.covariance);
    EXPECT_NEAR(correction.nis, in.residual.dot(S.inverse() * in.residual), 1e-8);
    EXPECT_NEAR(correction.log_determinant, std::log(S.determinant()), 1e-8);
    const SwingMatrix information =
        belief.covariance.inverse() + H.transpose() * Eigen::MatrixXd(m.covariance).inverse() * H;
    const SwingMatrix P = information.inverse();
    EXPECT_LT((correction.belief.covariance - P).norm(), 1e-8 * P.norm());
    const SwingVector mean =
        belief.mean + P * H.transpose() * Eigen::MatrixXd(m.covariance).inverse() * in.residual;
    EXPECT_LT((correction.belief.mean - mean).norm(), 1e-8);
  }
}

TEST(SwingMeasurement, WhatIsKnownIsNotMoved) {
  SwingBelief belief = anyBelief();
  belief.covariance.row(kSwingDry).setZero();
  belief.covariance.col(kSwingDry).setZero();
  SwingVector truth = anyState();
  truth(kSwingAngle) += 0.05;
  const auto after = correctSwing(belief, seen(truth, SwingSight::kPose), kPivot).belief;
  EXPECT_EQ(after.mean(kSwingDry), belief.mean(kSwingDry));
  EXPECT_EQ(after.covariance(kSwingDry, kSwingDry), 0.0);
}

}  // namespace
}  // namespace ringhook
