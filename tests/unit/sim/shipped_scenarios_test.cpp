// What the scenarios under app/config/scenarios promise, drawn from many seeds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/angle.h"
#include "sim/cell_draw.h"
#include "sim/cell_world.h"
#include "sim/hook_body.h"
#include "sim/scenario.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

Scenario shipped(const std::string& name) {
  return loadScenario(std::filesystem::path(RINGHOOK_SOURCE_DIR) / "app/config/scenarios" /
                      (name + ".yaml"));
}

/// Least and greatest of what many seeds gave.
struct Seen {
  double least = 1e9;
  double most = -1e9;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

struct Drawn {
  Seen speed;      ///< [m/s]
  Seen amplitude;  ///< [rad]
};

Drawn drawn(const Scenario& scenario) {
  Drawn all;
  CellOptions options = scenario.cell;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    options.seed = seed;
    const CellDraw cell = drawCell(options);
    all.speed.add(cell.belt_speed);
    for (const HookDraw& hook : cell.hooks) {
      for (int axis = 0; axis < 2; ++axis) {
        const double rate = hook.rate[axis] / swingFrequency(hook.pivot_height, axis);
        all.amplitude.add(std::hypot(hook.angle[axis], rate));
      }
    }
  }
  return all;
}

TEST(ShippedScenarios, AllAreThereUnderTheirNames) {
  for (const char* name :
       {"easy", "standard", "hard", "dark", "cluttered", "occluded", "stop-and-go"}) {
    EXPECT_EQ(shipped(name).name, name);
  }
}

TEST(ShippedScenarios, StandardDrawsFromTheRangesOfTheDesign) {
  const Scenario standard = shipped("standard");
  EXPECT_DOUBLE_EQ(standard.cell.ring.clearance, 0.004);
  const Drawn all = drawn(standard);
  EXPECT_GE(all.speed.least, 0.0999);
  EXPECT_LE(all.speed.most, 0.2001);
  EXPECT_LT(all.speed.least, 0.11) << "the range is used";
  EXPECT_GT(all.speed.most, 0.19);
  EXPECT_GE(all.amplitude.least, 4.999 * kDegree);
  EXPECT_LE(all.amplitude.most, 8.001 * kDegree);
  EXPECT_LT(all.amplitude.least, 5.2 * kDegree);
}

TEST(ShippedScenarios, StreamsOfOneSeedHaveNothingInCommon) {
  CellOptions options = shipped("standard").cell;
  double correlation = 0.0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    options.seed = seed;
    const CellDraw cell = drawCell(options);
    // The first draws of the first and of the third stream, each back in [-1, 1].
    const double first = (cell.belt_speed / options.belt.speed - 1.0) / options.belt.speed_spread;
    const double third = cell.belt.ripple[0].phase / std::numbers::pi - 1.0;
    correlation += 3.0 * first * third / 400.0;
  }
  EXPECT_LT(std::abs(correlation), 0.2) << "four standard deviations";
}

TEST(ShippedScenarios, HardDrawsFromTheRangesOfTheDesign) {
  const Scenario hard = shipped("hard");
  EXPECT_DOUBLE_EQ(hard.cell.ring.clearance, 0.0015);
  const Drawn all = drawn(hard);
  EXPECT_GE(all.speed.least, 0.1999);
  EXPECT_LE(all.speed.most, 0.3001);
  EXPECT_LE(all.amplitude.most, 15.001 * kDegree);
  EXPECT_GT(all.amplitude.most, 14.5 * kDegree);
}

TEST(ShippedScenarios, EasyDrawsWhatItAlwaysDrew) {
  // Seed 1 before belts had profiles and swings had ranges: a seed goes on meaning the same cell.
  CellOptions options = shipped("easy").cell;
  options.seed = 1;
  const CellDraw cell = drawCell(options);
  EXPECT_NEAR(cell.belt_speed, 0.049267753288025073, 1e-15);
  EXPECT_NEAR(cell.hooks[0].angle[0], -0.013614640876269535, 1e-15);
  EXPECT_NEAR(cell.hooks[2].rate[1], -0.11732182252602426, 1e-15);
  EXPECT_NEAR(cell.zero_error[5], 0.0001316477053696341, 1e-15);
}

TEST(ShippedScenarios, EachOfTheOthersChangesWhatItIsNamedAfter) {
  const Scenario standard = shipped("standard");
  EXPECT_LT(shipped("dark").cell.scene.light.brightness,
            0.2 * standard.cell.scene.light.brightness);
  EXPECT_GT(shipped("dark").camera.sensor.gain, 2.0);
  EXPECT_GT(shipped("cluttered").cell.scene.clutter, 2 * standard.cell.scene.clutter);
  EXPECT_EQ(standard.cell.scene.occluder.count, 0);
  EXPECT_GT(shipped("occluded").cell.scene.occluder.count, 0);
  EXPECT_GT(shipped("stop-and-go").cell.belt.stops, 0);
  for (const char* name : {"dark", "cluttered", "occluded"}) {
    const Scenario other = shipped(name);
    EXPECT_EQ(other.cell.belt.speed, standard.cell.belt.speed) << name;
    EXPECT_EQ(other.cell.belt.ripple, standard.cell.belt.ripple) << name;
    EXPECT_EQ(other.cell.hook.swing_about_x, standard.cell.hook.swing_about_x) << name;
    EXPECT_EQ(other.cell.ring.clearance, standard.cell.ring.clearance) << name;
  }
}

/// Everything that moves, at one instant, as numbers.
std::vector<double> stateOf(const CellWorld& world) {
  const CellTruth now = truth(world);
  std::vector<double> values{now.belt_travel, now.belt_speed, now.grip_force};
  const auto add = [&](const Pose& pose, const Twist& twist) {
    values.insert(values.end(), pose.matrix().data(), pose.matrix().data() + 16);
    values.insert(values.end(), twist.data(), twist.data() + 6);
  };
  for (const HookTruth& hook : now.hooks) {
    add(hook.fMo, hook.twist_f);
  }
  for (const RingTruth& ring : now.rings) {
    add(ring.fMr, ring.twist_f);
    values.push_back(ring.hook_impulse);
  }
  values.insert(values.end(), now.joints.data(), now.joints.data() + 6);
  return values;
}

/// A hurried stop-and-go, a ring taken and dropped meanwhile.
std::vector<double> twoSeconds(std::uint64_t seed) {
  CellOptions options = shipped("stop-and-go").cell;
  options.seed = seed;
  options.belt.start_s = 0.1;
  options.belt.run_s = options.belt.stand_s = {0.6, 0.8};
  options.ring.count = 2;
  CellWorld world(options);
  std::vector<double> all;
  for (int i = 0; i < 10; ++i) {
    world.setGripper(i < 5);
    world.setJointVelocity(JointVector::Constant(i % 2 == 0 ? 0.05 : -0.05), 0.15);
    world.advanceTo(Time::fromSeconds(0.2 * (i + 1)));
    const std::vector<double> now = stateOf(world);
    all.insert(all.end(), now.begin(), now.end());
  }
  return all;
}

TEST(ShippedScenarios, SameSeedMovesTheSameBitByBitAndAnotherOneDoesNot) {
  const std::vector<double> first = twoSeconds(11);
  EXPECT_EQ(first, twoSeconds(11));
  EXPECT_NE(first, twoSeconds(12));
}

}  // namespace
}  // namespace ringhook
