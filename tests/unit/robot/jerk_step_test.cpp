#include "robot/jerk_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ringhook {
namespace {

constexpr JointBounds kBounds{5.0, 20.0, 2.0, 0.004};  // full acceleration after ten periods

/// The sum on the way back to zero, term by term.
double sumOfWay(double acceleration, double step) {
  double sum = 0.0;
  for (double a = acceleration; a > 0.0; a -= step) {
    sum += a;
  }
  return sum;
}

TEST(JerkStep, InvertsTheSumOfTheWayBackToZero) {
  for (double a = 0.0; a < 50.0; a += 0.137) {
    EXPECT_NEAR(accelerationOfSum(sumOfWay(a, 2.0), 2.0), a, 1e-9);
    EXPECT_NEAR(accelerationOfSum(-sumOfWay(a, 2.0), 2.0), -a, 1e-9);
  }
}

TEST(JerkStep, ReachesASpeedInTheLeastNumberOfPeriods) {
  // Ten periods up to A, n at A, ten down again (the last one is zero): speed per period in A T.
  struct Case {
    double speed;
    int periods;
  };
  const double at = 20.0 * 0.004;
  for (const Case& c : {Case{0.1 * at, 1},                // one step of d T
                        Case{(0.1 + 0.2 + 0.1) * at, 3},  // triangle
                        Case{10.0 * at, 19},              // 0.1 ... 0.9, 1, 0.9 ... 0.1
                        Case{20.0 * at, 29}}) {           // ten more at A
    JointRate rate;
    int needed = 0;
    while (std::abs(rate.velocity - c.speed) > 1e-12 && needed < 100) {
      rate = stepTowards(rate, c.speed, 0.0, kBounds);
      ++needed;
    }
    EXPECT_EQ(needed, c.periods) << c.speed;
    EXPECT_NEAR(stepTowards(rate, c.speed, 0.0, kBounds).velocity, c.speed, 1e-12);
  }
}

TEST(JerkStep, BrakesInTheDistanceOfTheTrapezoid) {
  // Speed v over ten rising, n full and nine falling periods: the mean speed is v / 2.
  const double speed = 20.0 * 20.0 * 0.004;
  JointRate rate{speed, 0.0};
  double distance = 0.0;
  int periods = 0;
  while (std::abs(rate.velocity) > 1e-12) {
    rate = brakingStep(rate, kBounds);
    distance += 0.004 * rate.velocity;
    ++periods;
  }
  EXPECT_EQ(periods, 29);
  EXPECT_NEAR(distance, 0.5 * speed * 0.004 * (periods - 1), 1e-12);
}

TEST(JerkStep, NeverPassesAConstantTargetNorAnyBound) {
  std::mt19937_64 engine(41);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  JointRate rate;
  for (int hold = 0; hold < 20000; ++hold) {
    const double target = 5.0 * unit(engine);
    const double start = rate.velocity;
    const bool still = std::abs(rate.acceleration) < 1e-9;
    const int periods = hold % 2 == 0 ? 150 : 7;  // to the end, or cut short
    for (int k = 0; k < periods; ++k) {
      const JointRate next = stepTowards(rate, target, 0.0, kBounds);
      ASSERT_LE(std::abs(next.velocity), kBounds.velocity);
      ASSERT_LE(std::abs(next.acceleration), kBounds.acceleration);
      ASSERT_LE(std::abs(next.acceleration - rate.acceleration), kBounds.jerk_step + 1e-9);
      ASSERT_NEAR(next.velocity, rate.velocity + 0.004 * next.acceleration, 1e-12);
      if (still) {
        ASSERT_LE(next.velocity, std::max(start, target) + 1e-12);
        ASSERT_GE(next.velocity, std::min(start, target) - 1e-12);
      }
      rate = next;
    }
    if (periods == 150) {
      ASSERT_NEAR(rate.velocity, target, 1e-9);
    }
  }
}

TEST(JerkStep, KeepsTheSpeedLimitForTargetsThatRunAway) {
  std::mt19937_64 engine(42);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  JointRate rate;
  for (int k = 0; k < 200000; ++k) {
    const double target = k % 3 == 0 ? 5.0 * unit(engine) : std::copysign(5.0, unit(engine));
    const JointRate next = stepTowards(rate, target, 20.0 * unit(engine), kBounds);
    ASSERT_LE(std::abs(next.velocity), kBounds.velocity);
    ASSERT_LE(std::abs(next.acceleration - rate.acceleration), kBounds.jerk_step + 1e-9);
    ASSERT_NEAR(next.velocity, rate.velocity + 0.004 * next.acceleration, 1e-12);
    rate = next;
  }
}

}  // namespace
}  // namespace ringhook
