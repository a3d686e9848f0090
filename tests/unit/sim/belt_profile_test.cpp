#include "sim/belt_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "quiet_cell.h"
#include "sim/cell_draw.h"
#include "sim/cell_world.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

/// Starts after 1 s, stops after 5 s, creeps from 9 s on.
BeltProfile startStopCreep() {
  BeltProfile profile;
  profile.changes = {{1.0, 0.2}, {5.0, 0.0}, {9.0, 0.01}};
  profile.acceleration = 0.4;
  profile.jerk = 4.0;
  return profile;
}

TEST(BeltProfile, ARampTakesTheTimeAndWayOfAnSCurve) {
  const BeltProfile profile = startStopCreep();
  // 0.2 m/s at 0.4 m/s^2, rounded by 0.4 / 4 s at both ends: 0.5 + 0.1 s, half speed on average.
  EXPECT_NEAR(changeDuration(profile, 0.2), 0.6, 1e-12);
  EXPECT_EQ(beltTravel(profile, 1.0), 0.0);
  EXPECT_NEAR(beltTravel(profile, 1.6), 0.5 * 0.2 * 0.6, 1e-12);
  EXPECT_NEAR(beltSpeed(profile, 1.6), 0.2, 1e-12);
  EXPECT_NEAR(beltSpeed(profile, 1.3), 0.1, 1e-12) << "half way at half time";
  // Running until 5 s, then a ramp down, then standing.
  const double there = 0.06 + 0.2 * 3.4 + 0.06;
  EXPECT_NEAR(beltTravel(profile, 5.6), there, 1e-12);
  EXPECT_NEAR(beltTravel(profile, 8.9), there, 1e-12);
  EXPECT_NEAR(beltSpeed(profile, 7.0), 0.0, 1e-15);
  // 0.01 m/s does not reach the acceleration limit: twice sqrt(0.01 / 4) s.
  EXPECT_NEAR(changeDuration(profile, 0.01), 0.1, 1e-12);
}

TEST(BeltProfile, SpeedIsTheDerivativeOfTravel) {
  BeltProfile profile = startStopCreep();
  profile.ripple = {{0.04, 0.7}, {0.02, 2.0}, {0.01, 4.0}};
  const double h = 1e-5;
  for (int i = 1; i < 1200; ++i) {
    const double t = 0.01 * i + 0.003;
    const double slope = (beltTravel(profile, t + h) - beltTravel(profile, t - h)) / (2.0 * h);
    ASSERT_NEAR(slope, beltSpeed(profile, t), 1e-8) << t;
  }
}

TEST(BeltProfile, AccelerationAndJerkOfTheDriveStayBounded) {
  const BeltProfile profile = startStopCreep();
  const double h = 1e-4;
  double acceleration = 0.0;
  double jerk = 0.0;
  for (double t = 0.5; t < 10.0; t += 0.00037) {
    const double before = beltSpeed(profile, t - h);
    const double now = beltSpeed(profile, t);
    const double after = beltSpeed(profile, t + h);
    acceleration = std::max(acceleration, std::abs(after - before) / (2.0 * h));
    jerk = std::max(jerk, std::abs(after - 2.0 * now + before) / (h * h));
  }
  EXPECT_NEAR(acceleration, 0.4, 1e-3) << "reached, not passed";
  EXPECT_NEAR(jerk, 4.0, 0.01);
}

TEST(BeltProfile, RippleHasTheFrequencyOfTheChainsPitch) {
  BeltProfile profile;
  profile.initial_speed = 0.15;
  profile.pitch = 0.10;
  profile.ripple = {{0.03, 0.5}};
  // One period is pitch / speed = 2/3 s; over whole periods the ripple leaves no trace.
  const double period = 0.10 / 0.15;
  EXPECT_NEAR(beltTravel(profile, 6.0 * period), 0.6, 1e-12);
  double low = 1.0;
  double high = 0.0;
  int rises = 0;
  for (int i = 0; i < 4000; ++i) {
    const double t = 4.0 * period * i / 4000.0;
    const double speed = beltSpeed(profile, t);
    low = std::min(low, speed);
    high = std::max(high, speed);
    rises += speed < 0.15 && beltSpeed(profile, t + 4.0 * period / 4000.0) >= 0.15 ? 1 : 0;
  }
  EXPECT_EQ(rises, 4);
  EXPECT_NEAR(low, 0.15 * 0.97, 1e-6);
  EXPECT_NEAR(high, 0.15 * 1.03, 1e-6);
}

TEST(BeltProfile, DrawnStopsKeepTheirOrderAndTheSeedDecides) {
  CellOptions options;
  options.belt.speed = 0.2;
  options.belt.start_s = 1.0;
  options.belt.stops = 5;
  options.belt.run_s = {0.1, 6.0};
  options.belt.stand_s = {0.1, 3.0};
  options.belt.ripple = {0.03, 0.01};
  for (std::uint64_t seed = 1; seed < 50; ++seed) {
    options.seed = seed;
    const BeltProfile belt = drawCell(options).belt;
    ASSERT_EQ(belt.changes.size(), 11U);
    for (std::size_t i = 1; i < belt.changes.size(); ++i) {
      const SpeedChange& before = belt.changes[i - 1];
      ASSERT_GE(belt.changes[i].begin_s + 1e-12,
                before.begin_s + changeDuration(belt, belt.changes[i].to - before.to));
    }
    EXPECT_EQ(beltSpeed(belt, 0.9), 0.0);
    EXPECT_NEAR(beltSpeed(belt, 1e3), drawCell(options).belt_speed, 0.05 * 0.21);
  }
  options.seed = 1;
  const BeltProfile first = drawCell(options).belt;
  options.seed = 2;
  EXPECT_NE(first.ripple[0].phase, drawCell(options).belt.ripple[0].phase);
  EXPECT_NE(first.changes[3].begin_s, drawCell(options).belt.changes[3].begin_s);
}

/// One hook at rest on a belt with this profile, no losses.
CellOptions hangingStill(const BeltProfile& profile) {
  CellOptions options = quietCell();
  options.belt.profile = profile;
  return options;
}

/// A pendulum whose pivot moves, by hand: theta'' = -w^2 (sin theta + y'' / g cos theta),
/// integrated with steps of 10 us; the pivot's acceleration y'' from its speed by differences.
double swingByHand(const BeltProfile& profile, double frequency, double until_s) {
  const double h = 1e-5;
  double angle = 0.0;
  double rate = 0.0;
  for (double t = h; t < until_s; t += h) {
    const double d = 1e-4;
    const double pivot = (beltSpeed(profile, t + d) - beltSpeed(profile, t - d)) / (2.0 * d);
    rate -= h * frequency * frequency * (std::sin(angle) + pivot / 9.81 * std::cos(angle));
    angle += h * rate;
  }
  return angle;
}

TEST(BeltProfile, StartsAndRippleSetAHangingHookSwinging) {
  BeltProfile start;
  start.changes = {{0.2, 0.2}};
  BeltProfile ripple;
  ripple.initial_speed = 0.1;  // ripple at 1 Hz, near the hook's own 0.84 Hz
  ripple.ripple = {{0.05, 0.0}};
  for (const BeltProfile& profile : {start, ripple}) {
    const CellOptions options = hangingStill(profile);
    CellWorld world(options);
    world.advanceTo(Time::fromSeconds(0.2));
    double largest = 0.0;
    const double frequency = 2.0 * std::numbers::pi / 1.18685;
    for (int i = 21; i <= 400; i += 40) {
      world.advanceTo(Time::fromSeconds(0.01 * i));
      const double angle = truth(world).hooks[0].swing_about_x;
      EXPECT_NEAR(std::abs(angle), std::abs(swingByHand(profile, frequency, 0.01 * i)), 2e-4);
      largest = std::max(largest, std::abs(angle));
    }
    EXPECT_GT(largest, 5e-3);
  }
}

}  // namespace
}  // namespace ringhook
