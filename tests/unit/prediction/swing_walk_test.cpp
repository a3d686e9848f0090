#include "prediction/swing_walk.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "swing_trial.h"

namespace ringhook {
namespace {

SwingBelief certain() { return {anyState(), SwingMatrix::Zero()}; }

SwingNoise noNoise() {
  SwingNoise noise;
  noise.pivot_acceleration.setZero();
  noise.swing_density = noise.damping_density = noise.dry_density = 0.0;
  noise.rest_density = noise.yaw_density = 0.0;
  return noise;
}

SwingMatrix differences(const SwingVector& state, double dt, const SwingLaw& law) {
  SwingMatrix Phi;
  constexpr double kStep = 1e-6;
  for (int i = 0; i < kSwingStates; ++i) {
    SwingVector above = state;
    SwingVector below = state;
    above(i) += kStep;
    below(i) -= kStep;
    Phi.col(i) = (walkSwing(above, dt, law) - walkSwing(below, dt, law)) / (2.0 * kStep);
  }
  return Phi;
}

/// Van Loan's integral by brute force: many small steps, transitions by differences.
SwingMatrix integratedNoise(const SwingNoise& noise, double dt, const SwingLaw& law) {
  constexpr int kParts = 400;
  SwingMatrix W = SwingMatrix::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    W(kSwingAcceleration + axis, kSwingAcceleration + axis) =
        std::pow(noise.pivot_acceleration(axis), 2) * 2.0 / law.memory_s;
  }
  W(kSwingRate, kSwingRate) = W(kSwingRate + 1, kSwingRate + 1) = noise.swing_density;
  SwingMatrix Q = SwingMatrix::Zero();
  for (int i = 0; i < kParts; ++i) {
    const double at = (i + 0.5) * dt / kParts;
    const SwingMatrix left = differences(walkSwing(anyState(), at, law), dt - at, law);
    Q += left * W * left.transpose() * (dt / kParts);
  }
  return Q;
}

TEST(SwingWalk, TheTransitionIsTheWalksDerivative) {
  const SwingLaw law;
  for (const double dt : {0.01, 0.3, -0.1}) {
    const SwingTransition walked = walkSwingWithTransition(anyState(), dt, law);
    EXPECT_EQ(walked.state, walkSwing(anyState(), dt, law));
    EXPECT_LT((walked.Phi - differences(anyState(), dt, law)).cwiseAbs().maxCoeff(), 1e-6) << dt;
  }
}

TEST(SwingWalk, BackwardsUndoesForwards) {
  const SwingLaw law;
  const SwingVector there = walkSwing(anyState(), 0.02, law);
  EXPECT_LT((walkSwing(there, -0.02, law) - anyState()).norm(), 1e-7);
  const SwingTransition ahead = walkSwingWithTransition(anyState(), 0.02, law);
  const SwingTransition back = walkSwingWithTransition(there, -0.02, law);
  EXPECT_LT((back.Phi * ahead.Phi - SwingMatrix::Identity()).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(SwingWalk, TheMeanKeepsAMillionthOverAPeriodOfItsLongestSteps) {
  const SwingLaw law;
  SwingVector state = SwingVector::Zero();
  state(kSwingLogLength) = std::log(0.35);
  state(kSwingAngle) = 0.2;
  SwingVector fine = state;
  for (int i = 0; i < 1200; ++i) {
    fine = walkSwing(fine, 0.001, law);
  }
  EXPECT_LT((walkSwing(state, 1.2, law) - fine).segment<2>(kSwingAngle).norm(), 0.2 * 3e-5);
}

TEST(SwingWalk, ABeliefIsCarriedByTheTransition) {
  const SwingLaw law;
  SwingMatrix root;
  for (int i = 0; i < root.size(); ++i) {
    root(i / kSwingStates, i % kSwingStates) = std::sin(12.9 * i);
  }
  const SwingBelief belief{anyState(), root * root.transpose()};
  const SwingMatrix Phi = walkSwingWithTransition(anyState(), 0.25, law).Phi;
  const SwingBeliefWalk walked = walkSwingBeliefWithTransition(belief, 0.25, law, noNoise());
  const SwingMatrix expected = Phi * belief.covariance * Phi.transpose();
  EXPECT_LT((walked.Phi - Phi).norm(), 1e-12 * Phi.norm());
  EXPECT_LT((walked.belief.covariance - expected).norm(), 1e-12 * expected.norm());
  EXPECT_EQ(walked.belief.covariance, walked.belief.covariance.transpose());
}

TEST(SwingWalk, NoiseIsVanLoansIntegral) {
  const SwingLaw law;
  SwingNoise noise = noNoise();
  noise.pivot_acceleration << 0.1, 0.4, 0.2;
  noise.swing_density = 0.03;
  // A step takes the law as it is in its middle, which a swing of 1.5 rad/s feels in long steps.
  for (const auto& [dt, share] : {std::pair{0.02, 2e-3}, std::pair{0.15, 1e-2}}) {
    const SwingMatrix Q = walkSwingBelief(certain(), dt, law, noise).covariance;
    const SwingMatrix expected = integratedNoise(noise, dt, law);
    for (int i = 0; i < kSwingMoving; ++i) {
      for (int j = 0; j < kSwingMoving; ++j) {
        const double scale = std::sqrt(expected(i, i) * expected(j, j));
        EXPECT_NEAR(Q(i, j), expected(i, j), share * scale) << dt << ": " << i << ", " << j;
      }
    }
  }
}

TEST(SwingWalk, ChainNoiseIsExact) {  // Singer's own closed form for the pivot, 1970
  SwingLaw law;
  law.memory_s = 0.3;
  SwingNoise noise = noNoise();
  noise.pivot_acceleration << 0.0, 0.4, 0.0;
  const double dt = 0.02;
  const SwingMatrix Q = walkSwingBelief(certain(), dt, law, noise).covariance;
  const double e = std::exp(-dt / law.memory_s);
  EXPECT_NEAR(Q(kSwingAcceleration + 1, kSwingAcceleration + 1), 0.16 * (1.0 - e * e), 1e-9);
  EXPECT_NEAR(Q(kSwingSpeed + 1, kSwingAcceleration + 1),
              0.16 * law.memory_s * (1.0 + e * e - 2.0 * e), 1e-9);
}

TEST(SwingWalk, NoiseKeepsACovariancePositiveBothWays) {
  const SwingLaw law;
  const SwingNoise noise;
  for (const double dt : {-0.2, 0.2}) {
    const SwingMatrix P = walkSwingBelief(certain(), dt, law, noise).covariance;
    const Eigen::SelfAdjointEigenSolver<SwingMatrix> solver(P);
    EXPECT_GT(solver.eigenvalues().minCoeff(), -1e-16);
    EXPECT_NEAR(P(kSwingYaw, kSwingYaw), 0.2 * noise.yaw_density, 1e-15);
    EXPECT_NEAR(P(kSwingViscous, kSwingViscous), 0.2 * noise.damping_density, 1e-15);
  }
}

}  // namespace
}  // namespace ringhook
