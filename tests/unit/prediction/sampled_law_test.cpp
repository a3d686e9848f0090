#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "prediction/constant_acceleration.h"
#include "prediction/constant_velocity.h"
#include "prediction/exact_pendulum.h"
#include "prediction/pendulum.h"
#include "prediction/van_loan.h"

namespace ringhook {
namespace {

using Eigen::MatrixXd;

constexpr PendulumRates kUnderDamped{9.0, 0.4};
constexpr PendulumRates kCritical{9.0, 6.0};
constexpr PendulumRates kOverDamped{9.0, 14.0};

/// exp(F t) by its power series, in long steps of a small one.
MatrixXd seriesExponential(const MatrixXd& F, double t) {
  constexpr int kHalvings = 10;
  const MatrixXd small = F * (t / std::pow(2.0, kHalvings));
  MatrixXd term = MatrixXd::Identity(F.rows(), F.cols());
  MatrixXd sum = term;
  for (int k = 1; k < 20; ++k) {
    term = term * small / k;
    sum += term;
  }
  for (int i = 0; i < kHalvings; ++i) {
    sum = (sum * sum).eval();
  }
  return sum;
}

/// The integral of its definition, by Simpson's rule.
MatrixXd integratedNoise(const MatrixXd& F, const MatrixXd& W, double dt) {
  constexpr int kPieces = 400;
  MatrixXd sum = MatrixXd::Zero(F.rows(), F.cols());
  for (int i = 0; i <= kPieces; ++i) {
    const MatrixXd A = seriesExponential(F, dt * i / kPieces);
    const double weight = i == 0 || i == kPieces ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * A * W * A.transpose();
  }
  return sum * dt / kPieces / 3.0;
}

TEST(SampledLaw, IsTheExponentialAndTheIntegralOfItsDefinition) {
  const MatrixXd F = travellingDrift(kUnderDamped);
  const MatrixXd W = travellingDensity(0.7, 0.2);
  for (const double dt : {0.01, 0.3, 2.0}) {
    const SampledLaw law = sampleLaw(F, W, dt);
    EXPECT_TRUE(law.transition.isApprox(seriesExponential(F, dt), 1e-12)) << dt;
    EXPECT_TRUE(law.noise.isApprox(integratedNoise(F, W, dt), 1e-8)) << dt;
  }
}

TEST(SampledLaw, OneStepIsTwoOfHalfItsLength) {
  const MatrixXd F = driftingDrift(kOverDamped);
  const MatrixXd W = driftingDensity(0.3, 2.0);
  const SampledLaw half = sampleLaw(F, W, 0.15);
  const SampledLaw whole = sampleLaw(F, W, 0.30);
  EXPECT_TRUE(whole.transition.isApprox(half.transition * half.transition, 1e-13));
  const MatrixXd noise = half.transition * half.noise * half.transition.transpose() + half.noise;
  EXPECT_TRUE(whole.noise.isApprox(noise, 1e-12));
}

TEST(SampledLaw, GivesTheClosedFormsOfThePlainModels) {
  Eigen::Matrix2d F = Eigen::Matrix2d::Zero();
  F(0, 1) = 1.0;
  const SampledLaw velocity = sampleLaw(F, pendulumDensity(0.6), 0.2);
  EXPECT_TRUE(velocity.transition.isApprox(velocityTransition(0.2), 1e-14));
  EXPECT_TRUE(velocity.noise.isApprox(whiteAccelerationNoise(0.2, 0.6), 1e-13));
  Matrix9 F9 = Matrix9::Zero();
  F9.block<3, 3>(0, 3).setIdentity();
  F9.block<3, 3>(3, 6).setIdentity();
  Matrix9 W9 = Matrix9::Zero();
  W9.bottomRightCorner<3, 3>().diagonal().setConstant(0.6);
  EXPECT_TRUE(sampleLaw(F9, W9, 0.2).noise.isApprox(jerkNoise(0.2, 0.6), 1e-13));
}

TEST(ExactPendulum, IsTheMatrixExponentialUnderCriticallyAndOverDamped) {
  for (const auto& rates : {kUnderDamped, kCritical, kOverDamped, PendulumRates{9.0, 0.0},
                            PendulumRates{9.0, 6.0 + 1e-9}, PendulumRates{9.0, 6.0 - 1e-4}}) {
    for (const double dt : {0.0, 1e-5, 0.005, 0.1, 0.7, 3.0}) {
      const Eigen::Matrix2d F = dt * pendulumDrift(rates);
      EXPECT_TRUE(exactPendulumTransition(rates, dt).isApprox(F.exp(), 1e-12))
          << rates.damping << " " << dt;
    }
  }
}

TEST(ExactPendulum, StaysFiniteWhenDampedBeyondReason) {
  const Eigen::Matrix2d A = exactPendulumTransition({1.0, 1e4}, 10.0);
  EXPECT_TRUE(A.allFinite());
  EXPECT_NEAR(A(0, 0), std::exp(-1e-4 * 10.0), 1e-6);  // the slow root is k/c
}

TEST(ExactPendulum, BelowAMovingPivotIsTheMatrixExponentialToo) {
  for (const auto& rates : {kUnderDamped, kCritical, kOverDamped}) {
    for (const double dt : {0.02, 0.5}) {
      EXPECT_TRUE(exactTravellingTransition(rates, dt).isApprox(
          seriesExponential(travellingDrift(rates), dt), 1e-11));
      EXPECT_TRUE(exactDriftingTransition(rates, dt).isApprox(
          seriesExponential(driftingDrift(rates), dt), 1e-11));
    }
  }
}

// A pivot that is thrown forward leaves the load behind: s = -(a/k)(1 - cos wt).
TEST(ExactPendulum, IsLeftBehindByAPivotThatAccelerates) {
  const PendulumRates rates{4.0, 0.0};
  Eigen::Matrix<double, 5, 1> start;
  start << 0.0, 0.0, 0.8, 0.0, 0.0;
  const Eigen::Matrix<double, 5, 1> then = exactTravellingTransition(rates, 0.6) * start;
  EXPECT_NEAR(then(0), 0.5 * 0.8 * 0.36, 1e-12);
  EXPECT_NEAR(then(3), -0.2 * (1.0 - std::cos(1.2)), 1e-12);
  EXPECT_NEAR(then(4), -0.4 * std::sin(1.2), 1e-12);
}

// p + s is pushed by what the swing's own law leaves out, and by nothing else.
TEST(ExactPendulum, ADriftingPivotThatIsPushedLeavesTheLoadWhereItIs) {
  const Eigen::Matrix4d W = driftingDensity(0.7, 0.2);
  const Eigen::RowVector4d load_speed(0.0, 1.0, 0.0, 1.0);
  EXPECT_NEAR((load_speed * W * load_speed.transpose())(0), 0.2, 1e-15);
  EXPECT_NEAR(W(1, 1), 0.7, 1e-15);
}

TEST(ExactPendulum, IsWhatTheReportsMapTendsToWithTheFirstPowerOfItsStep) {
  PendulumParameters parameters;
  parameters.length_m = 0.35;
  parameters.damping_kg_per_s = 0.3;
  const PendulumRates rates = pendulumRates(0.35, 0.3, parameters.gravity);
  Eigen::Matrix2d exact = exactPendulumTransition(rates, 0.5);
  exact.col(1) /= parameters.length_m;  // its state is (phi, L phi')
  exact.row(1) *= parameters.length_m;
  const auto distance = [&](double step) {
    parameters.step_s = step;
    return (walkPendulum(parameters, 0.5, 0.0).transition - exact).norm();
  };
  EXPECT_NEAR(distance(1e-3) / distance(5e-4), 2.0, 0.02);
  EXPECT_LT(distance(1e-5), 1e-4);
}

}  // namespace
}  // namespace ringhook
