#include "servo/joint_move.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace ringhook {
namespace {

using ::testing::HasSubstr;

JointLimits someLimits() {
  JointLimits limits;
  limits.upper << 2.8, 2.2, 2.3, 4.7, 2.1, 4.7;
  limits.lower = -limits.upper;
  limits.velocity << 5.0, 5.0, 5.6, 7.2, 5.6, 12.2;
  limits.acceleration << 20.0, 20.0, 22.0, 29.0, 22.0, 49.0;
  return limits;
}

JointMove planOrFail(const JointVector& start, const JointVector& end, double fraction) {
  const auto move = planJointMove(start, end, someLimits(), fraction);
  if (move) {
    return *move;
  }
  ADD_FAILURE() << move.reason();
  return {JointVector::Zero(), JointVector::Zero(), 0.0};
}

JointVector randomJoints(std::mt19937& engine) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  return JointVector::NullaryExpr([&] { return unit(engine); }).cwiseProduct(someLimits().upper);
}

TEST(JointMove, KeepsSpeedAndAccelerationAndUsesOneOfThemFully) {
  std::mt19937 engine(5);
  const JointLimits limits = someLimits();
  for (int i = 0; i < 200; ++i) {
    const double fraction = 0.1 + 0.9 * (i / 199.0);
    const JointMove move = planOrFail(randomJoints(engine), randomJoints(engine), fraction);
    constexpr int kSteps = 2000;
    const double dt = move.duration_s / kSteps;
    double use = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      const JointVector v = sampleJointMove(move, k * dt).velocity;
      const JointVector a = (sampleJointMove(move, (k + 1) * dt).velocity - v) / dt;
      use = std::max(use, v.cwiseAbs().cwiseQuotient(fraction * limits.velocity).maxCoeff());
      use = std::max(use, a.cwiseAbs().cwiseQuotient(fraction * limits.acceleration).maxCoeff());
    }
    EXPECT_LT(use, 1.0 + 1e-9);
    EXPECT_GT(use, 0.999);
  }
}

TEST(JointMove, StartsAndStopsAtRestWithAllJointsTogether) {
  JointVector start;
  JointVector end;
  start << 0.0, 0.5, 1.0, 0.0, 0.3, 0.0;
  end << 1.0, 0.4, 1.5, -2.0, 0.3, 3.0;
  const JointMove move = planOrFail(start, end, 0.5);
  EXPECT_EQ(sampleJointMove(move, -1.0).position, start);
  EXPECT_EQ(sampleJointMove(move, move.duration_s + 1.0).position, end);
  EXPECT_TRUE(sampleJointMove(move, 0.0).velocity.isZero());
  EXPECT_TRUE(sampleJointMove(move, move.duration_s).velocity.isZero());
  const JointVector half = sampleJointMove(move, 0.5 * move.duration_s).position;
  EXPECT_TRUE(half.isApprox(0.5 * (start + end), 1e-12));
}

TEST(JointMove, ReportsTheDerivativeOfItsPosition) {
  std::mt19937 engine(6);
  const JointMove move = planOrFail(randomJoints(engine), randomJoints(engine), 0.7);
  constexpr double kStep = 1e-6;  // [s]
  for (double t = 0.01; t < move.duration_s - 0.01; t += 0.01) {
    const JointVector difference =
        (sampleJointMove(move, t + kStep).position - sampleJointMove(move, t - kStep).position) /
        (2.0 * kStep);
    EXPECT_LT((difference - sampleJointMove(move, t).velocity).norm(), 1e-7);
  }
}

TEST(JointMove, TrackingRemovesAStartingErrorExponentially) {
  std::mt19937 engine(7);
  const JointMove move = planOrFail(randomJoints(engine), randomJoints(engine), 0.3);
  constexpr double kGain = 8.0;   // [1/s]
  constexpr double kFine = 1e-4;  // [s]
  const JointVector offset = JointVector::Constant(0.05);
  JointVector q = move.start + offset;
  for (int k = 0; k < 5000; ++k) {
    // Midpoint rule: second order, so that sampling stays out of sight.
    const JointVector half = q + 0.5 * kFine * trackJointMove(move, k * kFine, q, kGain);
    q += kFine * trackJointMove(move, (k + 0.5) * kFine, half, kGain);
  }
  const JointVector left = q - sampleJointMove(move, 0.5).position;
  EXPECT_LT((left - std::exp(-kGain * 0.5) * offset).norm(), 1e-6);
}

TEST(JointMove, RefusesWhatItCannotPromise) {
  const JointLimits limits = someLimits();
  JointVector outside = JointVector::Zero();
  outside(2) = 2.4;
  const JointVector zero = JointVector::Zero();
  EXPECT_THAT(planJointMove(zero, outside, limits, 0.5).reason(), HasSubstr("J3"));
  EXPECT_TRUE(planJointMove(outside, zero, limits, 0.5).hasValue());
  EXPECT_FALSE(planJointMove(zero, zero, limits, 0.0).hasValue());
  EXPECT_FALSE(planJointMove(zero, zero, limits, 1.5).hasValue());
  outside(0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(planJointMove(outside, zero, limits, 0.5).reason(), HasSubstr("finite"));
}

TEST(JointMove, TakesNoTimeToGoNowhere) {
  const JointVector zero = JointVector::Zero();
  const JointMove move = planOrFail(zero, zero, 0.5);
  EXPECT_EQ(move.duration_s, 0.0);
  EXPECT_TRUE(sampleJointMove(move, 0.0).velocity.isZero());
}

}  // namespace
}  // namespace ringhook
