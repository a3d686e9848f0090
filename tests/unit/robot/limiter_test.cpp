#include "robot/limiter.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <deque>

#include "core/error.h"
#include "joint_samples.h"
#include "limiter_trial.h"

namespace ringhook {
namespace {

constexpr double kPeriod = 0.004;  // [s]

/// Away from limits and singularities.
JointVector middle() {
  JointVector q;
  q << 0.2, 0.3, 1.5, 0.1, -0.8, 0.3;
  return q;
}

/// A limiter and an arm that does exactly what it is sent.
struct Cell {
  explicit Cell(const JointVector& start, const LimiterSettings& the_settings = {})
      : settings(the_settings), limiter(settings), q(start) {}

  LimitedVelocity step(const JointVector& wanted, OperatingMode mode = OperatingMode::kAutomatic) {
    const LimitedVelocity out = limiter.limit(wanted, q, mode);
    q += kPeriod * out.velocity;
    return out;
  }
  LimitedVelocity run(int periods, const JointVector& wanted,
                      OperatingMode mode = OperatingMode::kAutomatic) {
    LimitedVelocity last;
    for (int k = 0; k < periods; ++k) {
      last = step(wanted, mode);
    }
    return last;
  }
  [[nodiscard]] double toolSpeed(const JointVector& v) const {
    const Twist twist = rx60::jacobian(settings.geometry, q) * v;
    const Eigen::Vector3d arm = rx60::forward(settings.geometry, q).linear() * settings.tool_e;
    return (twist.head<3>() + twist.tail<3>().cross(arm)).norm();
  }

  LimiterSettings settings;
  Limiter limiter;
  JointVector q;
};

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
  Cell cell(middle());
  JointVector wanted;
  wanted << 0.3, -0.2, 0.25, 0.3, -0.3, 0.4;
  cell.run(60, wanted);
  const LimitedVelocity out = cell.step(wanted);
  EXPECT_FALSE(out.limited());
  EXPECT_LT((out.velocity - wanted).norm(), 1e-12);
}

TEST(Limiter, FollowsASwingWithinItsLimitsWithoutLag) {
  // 0.5 rad/s at 1.35 s, as a hook swings: 2.3 rad/s^2, beyond one jerk step per period.
  Cell cell(middle());
  double worst = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double phase = 2.0 * M_PI / 1.35 * kPeriod * k;
    const JointVector wanted = JointVector::Constant(0.5 * std::sin(phase));
    const JointVector sent = cell.step(wanted).velocity;
    worst = k > 50 ? std::max(worst, (sent - wanted).cwiseAbs().maxCoeff()) : 0.0;
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(Limiter, ShortensTheWholeVectorWhenSpeedIsShort) {
  LimiterSettings settings;
  settings.velocity_fraction = 0.1;
  Cell cell(middle(), settings);
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
      Cell cell(middle());
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
  Cell cell(middle());
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
  Cell out_of_it(start);
  EXPECT_TRUE(out_of_it.run(100, JointVector::Unit(1)).position);
  EXPECT_EQ(out_of_it.q(1), start(1));
  out_of_it.run(100, -JointVector::Unit(1));
  EXPECT_LT(out_of_it.q(1), start(1) - 0.2);
}

TEST(Limiter, KeepsTheToolBelowItsSpeedInBothModes) {
  for (const OperatingMode mode : {OperatingMode::kAutomatic, OperatingMode::kManual}) {
    LimiterSettings settings;
    settings.tool_e << 0.0, 0.05, 0.15;
    Cell cell(middle(), settings);
    const double limit = mode == OperatingMode::kManual ? 0.25 : 1.8;
    double fastest = 0.0;
    for (int k = 0; k < 250; ++k) {
      JointVector wanted = JointVector::Zero();
      wanted(0) = 4.0;
      const JointVector q = cell.q;
      const LimitedVelocity out = cell.step(wanted, mode);
      Cell at(q, settings);
      fastest = std::max(fastest, at.toolSpeed(out.velocity));
      EXPECT_TRUE(k < 100 || out.tool_speed || out.position || mode == OperatingMode::kAutomatic);
    }
    EXPECT_LE(fastest, limit);
    EXPECT_GT(fastest, 0.9 * limit);
  }
}

TEST(Limiter, BrakesToManualSpeedWhenTheModeChanges) {
  Cell cell(middle());
  JointVector wanted = JointVector::Zero();
  wanted(0) = 2.0;
  cell.run(80, wanted);
  ASSERT_GT(cell.toolSpeed(cell.limiter.velocity()), 0.5);
  cell.run(60, wanted, OperatingMode::kManual);
  const double speed = cell.toolSpeed(cell.limiter.velocity());
  EXPECT_LE(speed, 0.25);
  EXPECT_GT(speed, 0.2);  // slow, not stuck
}

TEST(Limiter, SlowsDownNearASingularityAndPassesThroughIt) {
  JointVector start = middle();
  start(4) = -0.6;
  Cell cell(start);
  const JointLimits& limits = cell.settings.limits;
  double slowest = 1.0;
  for (int k = 0; k < 500; ++k) {
    const JointVector v = cell.step(3.0 * JointVector::Unit(4)).velocity;
    if (std::abs(std::sin(cell.q(4))) < 0.01) {
      slowest = std::min(slowest, v(4) / limits.velocity(4));
    }
  }
  EXPECT_LT(slowest, 0.1);   // the share left at the singularity,
  EXPECT_GT(slowest, 0.02);  // less what the jerk costs when the speed must rise again
  EXPECT_GT(cell.q(4), 0.5);
}

TEST(Limiter, StopsAtTheWallsOfItsBoxAndLeavesThemAgain) {
  LimiterSettings settings;
  settings.box.upper.y() = rx60::forward(settings.geometry, middle()).translation().y() + 0.1;
  Cell cell(middle(), settings);
  EXPECT_TRUE(cell.run(500, JointVector::Unit(0)).workspace);
  const double left =
      settings.box.upper.y() - rx60::forward(settings.geometry, cell.q).translation().y();
  EXPECT_GE(left, -1e-12);
  EXPECT_LE(left, 1e-4);
  const double before = cell.q(0);
  cell.run(100, -0.5 * JointVector::Unit(0));
  EXPECT_LT(cell.q(0), before - 0.1);
}

TEST(Limiter, BrakesAlongItsOwnModelWhileMeasurementsAreNoNumbers) {
  Cell cell(middle());
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
  Cell cell(middle());
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
    for (int k = 0; k < 40000; ++k) {
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

TEST(Limiter, IsNeverStuck) {
  JointSamples samples(91);
  for (int trial = 0; trial < 60; ++trial) {
    LimiterSettings settings;
    Cell cell(samples.within(settings.limits), settings);
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
