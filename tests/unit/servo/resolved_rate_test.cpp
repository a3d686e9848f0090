#include "servo/resolved_rate.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace ringhook {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine_); }
  JointVector vector() {
    return JointVector::NullaryExpr([this] { return unit(); });
  }
  Jacobian matrix() {
    return Jacobian::NullaryExpr([this] { return unit(); });
  }

 private:
  std::mt19937_64 engine_;
};

TEST(ResolvedRate, DeliversTheTwistAskedForAwayFromSingularities) {
  Random random(23);
  for (int k = 0; k < 1000; ++k) {
    const Jacobian fJe = Jacobian::Identity() + 0.1 * random.matrix();
    const Twist twist = 0.01 * random.vector();
    const ResolvedRate out = resolve(twist, fJe);
    EXPECT_FALSE(out.damped);
    EXPECT_LT((fJe * out.velocity - twist).norm(), 1e-14);
  }
}

TEST(ResolvedRate, DampsByTheLawOfNakamuraNearASingularity) {
  // J = diag(s, 1, ...): w = s, and q1' = s / (s^2 + l^2) v1.
  const ResolvedRateOptions options{0.05, 2e-3};
  for (const double s : {1.9e-3, 1e-3, 1e-5, 0.0}) {
    Jacobian fJe = Jacobian::Identity();
    fJe(0, 0) = s;
    Twist twist = Twist::Zero();
    twist(0) = 1e-3;
    const ResolvedRate out = resolve(twist, fJe, options);
    const double lambda = 0.05 * (1.0 - s / 2e-3);
    EXPECT_TRUE(out.damped);
    EXPECT_NEAR(out.manipulability, s, 1e-15);
    EXPECT_NEAR(out.velocity(0), s * 1e-3 / (s * s + lambda * lambda), 1e-12) << "s = " << s;
  }
}

TEST(ResolvedRate, StaysFiniteWhereTheArmIsSingular) {
  Random random(25);
  for (int k = 0; k < 1000; ++k) {
    Jacobian fJe = random.matrix();
    fJe.row(k % 6).setZero();
    const ResolvedRate out = resolve(random.vector(), fJe);
    EXPECT_TRUE(out.damped);
    EXPECT_LT(out.velocity.norm(),
              0.5 / 0.05 * 6.0);  // a singular value s gives s/(s^2+l^2) < 1/2l
  }
}

TEST(FlangeTwist, IsTheTwistThatMovesTheRingAsAsked) {
  Random random(24);
  constexpr double kStep = 1e-6;  // [s]
  for (int k = 0; k < 200; ++k) {
    const Pose fMe = expSe3(random.vector());
    const Pose eMr = expSe3(random.vector());
    const Twist twist_r = random.vector();
    const Twist twist_f = flangeTwist(fMe, eMr, twist_r);
    // Move the flange by its twist, seen from f, and look where the ring has gone.
    Pose fMe_after = fMe;
    fMe_after.linear() =
        makePoseThetaU({0, 0, 0}, kStep * twist_f.tail<3>()).linear() * fMe.linear();
    fMe_after.translation() += kStep * twist_f.head<3>();
    const Twist moved_r = logSe3((fMe * eMr).inverse() * fMe_after * eMr) / kStep;
    EXPECT_LT((moved_r - twist_r).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace ringhook
