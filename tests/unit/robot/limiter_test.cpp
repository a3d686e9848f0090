#include "robot/limiter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "joint_samples.h"
#include "limited_arm.h"
#include "limiter_trial.h"

namespace ringhook {
namespace {

TEST(Limiter, BreaksNoLimitWhateverGoesIn) {
  constexpr unsigned long kTrials = 200;
  WatchResult all;
  for (unsigned long seed = 1000; seed < 1000 + kTrials; ++seed) {
    const WatchResult result = LimiterTrial(seed).run(1000);
    EXPECT_EQ(result.total(), 0) << "seed " << seed;
    all.add(result);
  }
  // The limits were really met.
  EXPECT_GT(all.most[kSpeed], 1.0 - 1e-9);
  EXPECT_GT(all.most[kAcceleration], 1.0 - 1e-9);
  EXPECT_GT(all.most[kJerk], 1.0 - 1e-9);
  EXPECT_GT(all.most[kTool], 0.99);
  EXPECT_GT(all.most[kSingular], 0.99);
  EXPECT_GT(all.most[kPosition], -6e-4);
  EXPECT_GT(all.most[kBox], -1e-3);
}

TEST(Limiter, PassesUnchangedWhatBreaksNothing) {
  LimitedArm cell(middle());
  JointVector wanted;
  wanted << 0.3, -0.2, 0.25, 0.3, -0.3, 0.4;
  cell.run(60, wanted);
  const LimitedVelocity out = cell.step(wanted);
  EXPECT_FALSE(out.limited());
  EXPECT_LT((out.velocity - wanted).norm(), 1e-12);
}

TEST(Limiter, FollowsASwingWithinItsLimitsWithoutLag) {
  // 0.5 rad/s at 1.35 s, as a hook swings: 2.3 rad/s^2, beyond one jerk step per period.
  LimitedArm cell(middle());
  double worst = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double phase = 2.0 * std::numbers::pi / 1.35 * kPeriod * k;
    const JointVector wanted = JointVector::Constant(0.5 * std::sin(phase));
    const JointVector sent = cell.step(wanted).velocity;
    worst = k > 50 ? std::max(worst, (sent - wanted).cwiseAbs().maxCoeff()) : 0.0;
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(Limiter, ShortensTheWholeVectorWhenSpeedIsShort) {
  LimiterSettings settings;
  settings.velocity_fraction = 0.1;
  LimitedArm cell(middle(), settings);
  JointVector wanted;
  wanted << 10.0, -3.0, 0.5, 1.0, 0.5, 20.0;
  LimitedVelocity out;
  for (int k = 0; k < 100; ++k) {
    out = cell.step(wanted);
  }
  EXPECT_TRUE(out.speed);
  EXPECT_NEAR(out.velocity(0), 0.1 * settings.limits.velocity(0), 1e-9);
  EXPECT_LT((out.velocity.normalized() - wanted.normalized()).norm(), 1e-9);
}

TEST(Limiter, StopsEachJointWithinItsMarginAndLetsItComeBack) {
  const LimiterSettings settings;
  const double margin = settings.position_margin_rad;
  for (int joint = 0; joint < 6; ++joint) {
    for (const double sign : {1.0, -1.0}) {
      LimitedArm cell(middle());
      const LimitedVelocity last = cell.run(2500, sign * 100.0 * JointVector::Unit(joint));
      EXPECT_TRUE(last.position) << joint;
      const double left = sign > 0.0 ? settings.limits.upper(joint) - cell.q(joint)
                                     : cell.q(joint) - settings.limits.lower(joint);
      EXPECT_GE(left, margin - 1e-12) << joint;
      EXPECT_LE(left, margin + 1e-4) << joint;
      const double before = cell.q(joint);
      cell.run(100, -sign * 0.3 * JointVector::Unit(joint));
      EXPECT_GT(sign * (before - cell.q(joint)), 0.08) << joint;
    }
  }
}

TEST(Limiter, BrakesAheadOfALimitNoEarlierThanNeeded) {
  // From nominal speed: v^2 / 2A, and half the time of the jerk, A / J, at that speed.
  LimitedArm cell(middle());
  const JointLimits& limits = cell.settings.limits;
  cell.q(5) = -4.0;
  double onset = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const LimitedVelocity out = cell.step(100.0 * JointVector::Unit(5));
    if (out.velocity(5) >= limits.velocity(5) * (1.0 - 1e-12)) {
      onset = cell.q(5);
    }
  }
  const double v = limits.velocity(5);
  const double expected =
      v * v / (2.0 * limits.acceleration(5)) + 0.5 * v * limits.acceleration(5) / limits.jerk(5);
  const double braked = limits.upper(5) - cell.settings.position_margin_rad - onset;
  EXPECT_GE(braked, expected - v * kPeriod);
  EXPECT_LE(braked, expected + 2.0 * v * kPeriod);
}

TEST(Limiter, LetsAnArmBeyondALimitOnlyComeBack) {
  JointVector start = middle();
  start(1) = LimiterSettings{}.limits.upper(1) + 0.02;
  LimitedArm out_of_it(start);
  EXPECT_TRUE(out_of_it.run(100, JointVector::Unit(1)).position);
  EXPECT_EQ(out_of_it.q(1), start(1));
  out_of_it.run(100, -JointVector::Unit(1));
  EXPECT_LT(out_of_it.q(1), start(1) - 0.2);
}

TEST(Limiter, IsNeverStuck) {
  JointSamples samples(91);
  for (int trial = 0; trial < 60; ++trial) {
    LimiterSettings settings;
    LimitedArm cell(samples.within(settings.limits), settings);
    cell.run(200, 5.0 * samples.within(settings.limits));  // into some limit
    const JointVector goal = 0.8 * samples.within(settings.limits);
    for (int k = 0; k < 4000; ++k) {
      cell.step(3.0 * (goal - cell.q));
    }
    EXPECT_LT((goal - cell.q).cwiseAbs().maxCoeff(), 1e-3) << "trial " << trial;
  }
}

TEST(Limiter, RefusesSettingsThatMeanNothing) {
  const auto refuses = [](auto change) {
    LimiterSettings settings;
    change(settings);
    EXPECT_THROW(Limiter{settings}, InputError);
  };
  refuses([](LimiterSettings& s) { s.velocity_fraction = 0.0; });
  refuses([](LimiterSettings& s) { s.velocity_fraction = 1.1; });
  refuses([](LimiterSettings& s) { s.limits.jerk(3) = std::nan(""); });
  refuses([](LimiterSettings& s) { s.limits.upper(1) = s.limits.lower(1); });
  refuses([](LimiterSettings& s) { s.tool_speed_automatic_m_s = 2.0; });
  refuses([](LimiterSettings& s) { s.tool_e(0) = std::nan(""); });
  refuses([](LimiterSettings& s) { s.box.lower(2) = s.box.upper(2); });
  refuses([](LimiterSettings& s) { s.least_share = 0.0; });
  refuses([](LimiterSettings& s) { s.lag_periods = 9; });
  refuses([](LimiterSettings& s) { s.period_s = 0.0; });
}

}  // namespace
}  // namespace ringhook
