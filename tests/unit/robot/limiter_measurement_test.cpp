#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "limited_arm.h"

namespace ringhook {
namespace {

TEST(Limiter, BrakesAlongItsOwnModelWhileMeasurementsAreNoNumbers) {
  LimitedArm cell(middle());
  const JointVector wanted = 0.5 * JointVector::Ones();
  cell.run(100, wanted);
  const JointVector nan = JointVector::Constant(std::numeric_limits<double>::quiet_NaN());
  LimitedVelocity out;
  for (int k = 0; k < 60; ++k) {
    out = cell.limiter.limit(wanted, nan);
    EXPECT_TRUE(out.bad_input);
    cell.q += kPeriod * out.velocity;
  }
  EXPECT_LT(out.velocity.norm(), 1e-12);
  EXPECT_FALSE(cell.run(60, wanted).limited());  // and goes on when it sees again
}

TEST(Limiter, DoesNotMoveBeforeItKnowsWhereTheArmIs) {
  Limiter limiter{LimiterSettings{}};
  const JointVector nan = JointVector::Constant(std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < 10; ++k) {
    const LimitedVelocity out = limiter.limit(JointVector::Ones(), nan);
    EXPECT_TRUE(out.bad_input);
    EXPECT_TRUE(out.velocity.isZero(0.0));
  }
}

TEST(Limiter, DoesNotBelieveAJumpButANewPlaceAtRest) {
  LimitedArm cell(middle());
  cell.run(60, 0.5 * JointVector::Ones());
  cell.q(2) -= 1.0;
  EXPECT_TRUE(cell.run(5, JointVector::Ones()).bad_input);
  cell.run(60, JointVector::Ones());
  EXPECT_FALSE(cell.run(60, 0.2 * JointVector::Ones()).bad_input);
}

TEST(Limiter, KeepsPositionLimitsInSpiteOfNoiseAndLag) {
  for (int lag = 0; lag <= 3; ++lag) {
    std::mt19937_64 engine(static_cast<unsigned>(70 + lag));
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const LimiterSettings settings;
    Limiter limiter(settings);
    JointVector q = middle();
    std::deque<JointVector> seen(static_cast<std::size_t>(lag) + 1, q);
    JointVector wanted = JointVector::Zero();
    double nearest = 1.0;
    for (int k = 0; k < 15000; ++k) {
      if (k % 150 == 0) {
        wanted = 20.0 * JointVector::NullaryExpr([&] { return unit(engine); });
      }
      const JointVector noise = 1e-4 * JointVector::NullaryExpr([&] { return unit(engine); });
      q += kPeriod * limiter.limit(wanted, seen.front() + noise).velocity;
      seen.push_back(q);
      seen.pop_front();
      nearest = std::min(nearest, (settings.limits.upper - q).minCoeff());
      nearest = std::min(nearest, (q - settings.limits.lower).minCoeff());
    }
    EXPECT_GT(nearest, 0.0) << "lag of " << lag << " periods";
    EXPECT_LT(nearest, 0.02) << "lag of " << lag << " periods";  // limits were met
  }
}

TEST(Limiter, KeepsPositionLimitsAndArrivesWhenCommandsAreLost) {
  std::mt19937_64 engine(75);
  const LimiterSettings settings;
  Limiter limiter(settings);
  JointVector q = middle();
  const JointVector goal = limiter.reach().upper;
  for (int k = 0; k < 4000; ++k) {
    const LimitedVelocity out = limiter.limit(5.0 * (goal - q), q);
    EXPECT_FALSE(out.bad_input);
    if (engine() % 3 != 0) {
      q += kPeriod * out.velocity;  // else the arm stands still for a period
    }
    ASSERT_TRUE((q.array() <= settings.limits.upper.array()).all());
  }
  EXPECT_LT((goal - q).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Limiter, StartsFromRestAnywhereAfterAReset) {
  LimitedArm arm(middle());
  arm.run(60, JointVector::Ones());
  arm.limiter.reset();
  arm.q = -0.5 * middle();
  const LimitedVelocity out = arm.step(JointVector::Ones());
  EXPECT_FALSE(out.bad_input);
  const JointVector first = kPeriod * kPeriod * arm.settings.limits.jerk;  // one step of the jerk
  EXPECT_LE(out.velocity.cwiseQuotient(first).maxCoeff(), 1.0 + 1e-9);
  EXPECT_GT(out.velocity.minCoeff(), 0.0);
}

}  // namespace
}  // namespace ringhook
