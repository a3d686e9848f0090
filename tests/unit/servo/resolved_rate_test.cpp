#include "servo/resolved_rate.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

namespace ringhook {
namespace {

constexpr double kPeriod = 0.004;  // [s]
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kHuge = std::numeric_limits<double>::max();

JointLimits someLimits() {
  JointLimits limits;
  limits.lower << -2.8, -2.2, -2.3, -4.7, -1.9, -4.7;
  limits.upper << 2.8, 2.2, 2.3, 4.7, 2.1, 4.7;
  limits.velocity << 5.0, 5.0, 5.6, 7.2, 5.6, 12.2;
  limits.acceleration << 20.0, 20.0, 22.0, 29.0, 22.0, 49.0;
  return limits;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine_); }
  /// Sizes from 1e-3 to 1e3, both signs.
  double wild() { return std::pow(10.0, 3.0 * unit()) * unit(); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }
  JointVector vector() {
    return JointVector::NullaryExpr([this] { return unit(); });
  }
  JointVector wildVector() {
    return JointVector::NullaryExpr([this] { return wild(); });
  }
  Jacobian matrix() {
    return Jacobian::NullaryExpr([this] { return unit(); });
  }

 private:
  std::mt19937_64 engine_;
};

/// Worst use of each limit, 1 = exactly at it; position as distance beyond [rad].
struct Worst {
  double speed = 0.0;
  double acceleration = 0.0;
  double beyond = -1.0;

  void add(const JointVector& velocity, const JointVector& previous, const JointVector& q_after) {
    const JointLimits limits = someLimits();
    const JointVector change = (velocity - previous) / kPeriod;
    speed = std::max(speed, velocity.cwiseAbs().cwiseQuotient(limits.velocity).maxCoeff());
    acceleration =
        std::max(acceleration, change.cwiseAbs().cwiseQuotient(limits.acceleration).maxCoeff());
    beyond = std::max(beyond, (q_after - limits.upper).cwiseMax(limits.lower - q_after).maxCoeff());
  }
};

TEST(ResolvedRate, BreaksNoLimitInAHundredThousandRandomPeriods) {
  Random random(21);
  const JointLimits limits = someLimits();
  JointVector q = JointVector::Zero();
  JointVector previous = JointVector::Zero();
  JointVector wanted = JointVector::Zero();
  Worst worst;
  int position_limited = 0;
  for (int k = 0; k < 100000; ++k) {
    if (random.below(60) == 0) {
      wanted = random.wildVector();  // long enough in one direction to run into the limits
    }
    Jacobian fJe = Jacobian::Identity() + 0.3 * random.matrix();
    if (random.below(20) == 0) {
      fJe.row(random.below(6)).setZero();
    }
    const auto out = resolve(fJe * wanted, fJe, q, previous, limits, kPeriod);
    ASSERT_TRUE(out.velocity.allFinite());
    q += kPeriod * out.velocity;
    worst.add(out.velocity, previous, q);
    previous = out.velocity;
    position_limited += out.position_limited ? 1 : 0;
  }
  EXPECT_LE(worst.speed, 1.0);
  EXPECT_LE(worst.acceleration, 1.0 + 1e-9);
  EXPECT_LE(worst.beyond, 1e-12);
  EXPECT_GT(worst.beyond, -1e-3);  // the limits were really met
  EXPECT_GT(position_limited, 1000);
  std::printf("speed %.6f, acceleration %.9f of the limit, position %.2e rad, %d at positions\n",
              worst.speed, worst.acceleration, worst.beyond, position_limited);
}

TEST(ResolvedRate, EmitsFiniteSafeVelocitiesForAnyGarbage) {
  Random random(22);
  const JointLimits limits = someLimits();
  const double garbage[] = {kNan, std::numeric_limits<double>::infinity(), -kHuge, kHuge, 1e-308};
  for (int k = 0; k < 100000; ++k) {
    Twist twist = random.wildVector();
    Jacobian fJe = random.matrix();
    JointVector q = random.vector().cwiseProduct(limits.upper);
    JointVector previous = random.vector().cwiseProduct(limits.velocity);
    JointLimits used = limits;
    double period = kPeriod;
    const double value = garbage[random.below(5)];
    double* const victims[] = {&twist(2),      &fJe(1, 4),        &q(3),
                               &previous(5),   &used.velocity(1), &used.acceleration(0),
                               &used.upper(2), &used.lower(4),    &period};
    *victims[random.below(9)] = value;
    const auto out = resolve(twist, fJe, q, previous, used, period);
    ASSERT_TRUE(out.velocity.allFinite());
    ASSERT_TRUE((out.velocity.cwiseAbs().array() <= used.velocity.cwiseAbs().array()).all() ||
                out.velocity.isZero());
  }
}

TEST(ResolvedRate, SlowsDownAsFastAsAllowedOnBadInput) {
  const JointLimits limits = someLimits();
  const JointVector previous = 0.5 * limits.velocity;
  Twist twist = Twist::Zero();
  twist(0) = kNan;
  const auto out =
      resolve(twist, Jacobian::Identity(), JointVector::Zero(), previous, limits, kPeriod);
  EXPECT_TRUE(out.bad_input);
  EXPECT_TRUE(out.acceleration_limited);
  const JointVector slower = previous - out.velocity;
  EXPECT_NEAR(slower.cwiseQuotient(kPeriod * limits.acceleration).maxCoeff(), 1.0, 1e-9);
  EXPECT_TRUE((out.velocity.array() >= 0.0).all());
}

TEST(ResolvedRate, DeliversTheTwistAskedForAwayFromEveryLimit) {
  Random random(23);
  for (int k = 0; k < 1000; ++k) {
    const Jacobian fJe = Jacobian::Identity() + 0.1 * random.matrix();
    const Twist twist = 0.01 * random.vector();
    const auto out =
        resolve(twist, fJe, JointVector::Zero(), JointVector::Zero(), someLimits(), kPeriod);
    EXPECT_FALSE(out.limited());
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
    const auto out = resolve(twist, fJe, JointVector::Zero(), JointVector::Zero(), someLimits(),
                             kPeriod, options);
    const double lambda = 0.05 * (1.0 - s / 2e-3);
    EXPECT_TRUE(out.damped);
    EXPECT_NEAR(out.manipulability, s, 1e-15);
    const double expected = s * 1e-3 / (s * s + lambda * lambda);
    EXPECT_NEAR(out.velocity(0), std::min(expected, 20.0 * kPeriod), 1e-12) << "s = " << s;
  }
}

TEST(ResolvedRate, KeepsTheDirectionWhenSpeedIsShort) {
  const JointLimits limits = someLimits();
  JointVector wanted;
  wanted << 10.0, -3.0, 0.0, 1.0, 0.5, 20.0;
  const JointVector previous = wanted * 0.495;  // near enough for acceleration not to count
  const auto out = limitVelocity(wanted, JointVector::Zero(), previous, limits, kPeriod);
  EXPECT_TRUE(out.speed_limited);
  EXPECT_FALSE(out.acceleration_limited);
  EXPECT_TRUE(out.velocity.isApprox(0.5 * wanted, 1e-12));
}

TEST(ResolvedRate, StopsAtThePositionLimitWithoutOvershoot) {
  const JointLimits limits = someLimits();
  const JointVector wanted = JointVector::Unit(0) * 100.0;
  JointVector q = JointVector::Zero();
  JointVector previous = JointVector::Zero();
  double top_speed = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const auto out = limitVelocity(wanted, q, previous, limits, kPeriod);
    const double distance = limits.upper(0) - q(0);
    EXPECT_LE(out.velocity(0), std::sqrt(2.0 * limits.acceleration(0) * distance) + 1e-12);
    q += kPeriod * out.velocity;
    previous = out.velocity;
    top_speed = std::max(top_speed, previous(0));
  }
  EXPECT_NEAR(top_speed, limits.velocity(0), 1e-12);  // braking starts no earlier than needed
  EXPECT_LE(q(0), limits.upper(0));
  EXPECT_GT(q(0), limits.upper(0) - 1e-3);
}

TEST(ResolvedRate, LetsAJointBeyondItsLimitOnlyComeBack) {
  const JointLimits limits = someLimits();
  JointVector q = JointVector::Zero();
  q(1) = limits.upper(1) + 0.01;
  const JointVector rest = JointVector::Zero();
  EXPECT_EQ(limitVelocity(JointVector::Unit(1), q, rest, limits, kPeriod).velocity(1), 0.0);
  EXPECT_LT(limitVelocity(-JointVector::Unit(1), q, rest, limits, kPeriod).velocity(1), 0.0);
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
