#include <gtest/gtest.h>

#include <cmath>

#include "limited_arm.h"

namespace ringhook {
namespace {

TEST(Limiter, KeepsTheToolBelowItsSpeedInBothModes) {
  for (const OperatingMode mode : {OperatingMode::kAutomatic, OperatingMode::kManual}) {
    LimiterSettings settings;
    settings.tool_e << 0.0, 0.05, 0.15;
    LimitedArm cell(middle(), settings);
    const double limit = mode == OperatingMode::kManual ? 0.25 : 1.8;
    double fastest = 0.0;
    for (int k = 0; k < 250; ++k) {
      JointVector wanted = JointVector::Zero();
      wanted(0) = 4.0;
      const JointVector q = cell.q;
      const LimitedVelocity out = cell.step(wanted, mode);
      LimitedArm at(q, settings);
      fastest = std::max(fastest, at.toolSpeed(out.velocity));
      EXPECT_TRUE(k < 100 || out.tool_speed || out.position || mode == OperatingMode::kAutomatic);
    }
    EXPECT_LE(fastest, limit);
    EXPECT_GT(fastest, 0.9 * limit);
  }
}

TEST(Limiter, BrakesToManualSpeedWhenTheModeChanges) {
  LimitedArm cell(middle());
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
  LimitedArm cell(start);
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
  LimitedArm cell(middle(), settings);
  EXPECT_TRUE(cell.run(500, JointVector::Unit(0)).workspace);
  const double left =
      settings.box.upper.y() - rx60::forward(settings.geometry, cell.q).translation().y();
  EXPECT_GE(left, -1e-12);
  EXPECT_LE(left, 1e-4);
  const double before = cell.q(0);
  cell.run(100, -0.5 * JointVector::Unit(0));
  EXPECT_LT(cell.q(0), before - 0.1);
}

}  // namespace
}  // namespace ringhook
