#include "sim/cell_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>

#include "core/error.h"
#include "quiet_cell.h"
#include "scripted_arm.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

/// The hook of doc/frames.md once more, by hand: mass, centre of mass and the moment of inertia
/// about x through the pivot, from rods (shank, tip), the closed-form half circle and two plates.
struct HandHook {
  double mass = 0.0;
  double moment_z = 0.0;
  double inertia_pivot_x = 0.0;

  void bar(double m, double y, double z, double own, double pivot_y, double pivot_z) {
    mass += m;
    moment_z += m * z;
    inertia_pivot_x += own + m * ((y - pivot_y) * (y - pivot_y) + (z - pivot_z) * (z - pivot_z));
  }
};

HandHook handHook(double pivot_y, double pivot_z) {
  const double pi = std::numbers::pi;
  const double r = 0.035;
  const double line = 7850.0 * 0.012 * 0.006;
  const double shank = line * 0.450;
  const double tip = line * 0.025;
  const double arc = line * pi * r;
  const double plate = 2700.0 * 0.002 * 0.054 * 0.108;
  // Strip behind the shank with the plate's moment about x = 0.
  const double per_t = 7850.0 * 0.012 * 0.108;
  const double t = -0.003 + std::sqrt(0.003 * 0.003 + 2.0 * plate * 0.004 / per_t);
  HandHook hook;
  const auto rod = [](double m, double a, double b) { return m / 12.0 * (a * a + b * b); };
  hook.bar(shank, -r, 0.225, rod(shank, 0.450, 0.012), pivot_y, pivot_z);
  hook.bar(tip, r, 0.0125, rod(tip, 0.025, 0.012), pivot_y, pivot_z);
  const double arc_z = -2.0 * r / pi;
  hook.bar(arc, 0.0, arc_z, arc * (r * r + 0.012 * 0.012 / 12.0 - arc_z * arc_z), pivot_y, pivot_z);
  hook.bar(plate, -r, 0.200, rod(plate, 0.054, 0.108), pivot_y, pivot_z);
  hook.bar(per_t * t, -r, 0.200, rod(per_t * t, 0.012, 0.108), pivot_y, pivot_z);
  return hook;
}

TEST(CellWorld, SmallSwingHasTheCompoundPendulumsPeriod) {
  CellOptions options = quietCell();
  options.hook.swing_about_x = 0.01;
  CellWorld world(options);
  const CellTruth start = truth(world);
  const Eigen::Vector3d pivot_o = start.hooks[0].fMo.inverse() * start.hooks[0].fMp.translation();
  EXPECT_NEAR(pivot_o.z(), 0.450, 1e-12);
  const HandHook hook = handHook(pivot_o.y(), pivot_o.z());
  const double distance = pivot_o.z() - hook.moment_z / hook.mass;
  const double expected =
      2.0 * std::numbers::pi * std::sqrt(hook.inertia_pivot_x / (hook.mass * 9.81 * distance));

  std::vector<double> upward;
  double before = start.hooks[0].swing_about_x;
  while (upward.size() < 6) {
    world.advanceTo(world.time() + 0.0005);
    const double now = truth(world).hooks[0].swing_about_x;
    if (before < 0.0 && now >= 0.0) {
      upward.push_back(world.time().seconds() - 0.0005 * now / (now - before));
    }
    before = now;
  }
  const double period = (upward.back() - upward.front()) / 5.0;
  std::printf("period %.6f s, formula %.6f s\n", period, expected);
  EXPECT_NEAR(period, expected, 1e-4 * expected);
}

TEST(CellWorld, AnUndampedSwingKeepsItsEnergyAtEveryInstant) {
  CellOptions options = quietCell();
  options.hook.swing_about_x = 0.2;
  CellWorld world(options);
  const Eigen::Vector3d pivot_o =
      truth(world).hooks[0].fMo.inverse() * truth(world).hooks[0].fMp.translation();
  const HandHook hook = handHook(pivot_o.y(), pivot_o.z());
  const double distance = pivot_o.z() - hook.moment_z / hook.mass;
  const auto energy = [&] {
    const HookTruth now = truth(world).hooks[0];
    const double rate = now.twist_f[3];
    return 0.5 * hook.inertia_pivot_x * rate * rate +
           hook.mass * 9.81 * distance * (1.0 - std::cos(now.swing_about_x));
  };
  const double start = energy();
  for (int i = 0; i < 2000; ++i) {
    world.advanceTo(world.time() + 0.01);
    ASSERT_NEAR(energy(), start, 1e-4 * start) << world.time().seconds();
  }
}

TEST(CellWorld, FrictionAndAirTakeEnergyFromTheSwing) {
  CellOptions options = quietCell();
  options.hook.swing_about_x = 0.1;
  options.hook.pivot_friction = CellOptions{}.hook.pivot_friction;
  options.hook.pivot_damping = CellOptions{}.hook.pivot_damping;
  options.air_density = CellOptions{}.air_density;
  CellWorld world(options);
  double early = 0.0;
  double late = 0.0;
  for (int i = 0; i < 1200; ++i) {
    world.advanceTo(world.time() + 0.01);
    const double angle = std::abs(truth(world).hooks[0].swing_about_x);
    early = i < 200 ? std::max(early, angle) : early;
    late = i >= 1000 ? std::max(late, angle) : late;
  }
  EXPECT_LT(late, 0.97 * early);
  EXPECT_GT(late, 0.70 * early) << "losses are meant to be slight";
}

TEST(CellWorld, AHookAtRestHangsStraight) {
  CellWorld world(quietCell());
  world.advanceTo(Time::fromSeconds(3.0));
  const HookTruth hook = truth(world).hooks[0];
  EXPECT_NEAR(hook.swing_about_x, 0.0, 1e-6);
  EXPECT_NEAR(hook.swing_about_y, 0.0, 1e-6);
  EXPECT_NEAR(hook.fMo.translation().z(), 0.60, 1e-9);
  EXPECT_NEAR(hook.fMo.translation().x(), 0.42, 1e-6);
}

TEST(CellWorld, BeltFollowsItsProfile) {
  CellOptions options = quietCell();
  BeltProfile profile;
  profile.initial_speed = 0.2;
  profile.changes = {{1.0, 0.1}};
  profile.ripple = {{0.05, 0.3}, {0.02, 1.0}};
  options.belt.profile = profile;
  CellWorld world(options);
  const double y0 = truth(world).hooks[0].fMp.translation().y();
  for (int i = 1; i <= 200; ++i) {
    world.advanceTo(Time::fromSeconds(0.01 * i));
    const CellTruth now = truth(world);
    EXPECT_NEAR(now.hooks[0].fMp.translation().y() - y0, beltTravel(profile, 0.01 * i), 1e-8);
    EXPECT_NEAR(now.belt_speed, beltSpeed(profile, 0.01 * i), 5e-4);
  }
}

TEST(CellWorld, HooksSwingFromTheEntryOn) {
  CellOptions options;
  options.hook.count = 2;
  options.belt.speed = 0.4;
  CellWorld world(options);
  EXPECT_TRUE(truth(world).hooks[0].swinging);
  world.advanceTo(Time::fromSeconds(1.8));
  EXPECT_FALSE(truth(world).hooks[1].swinging);
  EXPECT_EQ(truth(world).hooks[1].swing_about_x, 0.0);
  world.advanceTo(Time::fromSeconds(2.3));
  EXPECT_TRUE(truth(world).hooks[1].swinging);
  EXPECT_GT(
      std::abs(truth(world).hooks[1].swing_about_x) + std::abs(truth(world).hooks[1].twist_f[3]),
      1e-3);
}

TEST(CellWorld, SameSeedGivesTheSameBits) {
  const auto run = [](std::uint64_t seed) {
    CellOptions options;
    options.seed = seed;
    CellWorld world(options);
    world.setGripper(true);
    world.setJointVelocity(JointVector::Constant(0.05), 1.0);
    world.advanceTo(Time::fromSeconds(1.0));
    world.setGripper(false);
    world.advanceTo(Time::fromSeconds(2.0));
    return truth(world);
  };
  const CellTruth a = run(3);
  const CellTruth b = run(3);
  const CellTruth c = run(4);
  for (std::size_t i = 0; i < a.hooks.size(); ++i) {
    EXPECT_TRUE(a.hooks[i].fMo.matrix() == b.hooks[i].fMo.matrix());
    EXPECT_TRUE(a.hooks[i].twist_f == b.hooks[i].twist_f);
  }
  for (std::size_t i = 0; i < a.rings.size(); ++i) {
    EXPECT_TRUE(a.rings[i].fMr.matrix() == b.rings[i].fMr.matrix());
    EXPECT_TRUE(a.rings[i].twist_f == b.rings[i].twist_f);
  }
  EXPECT_TRUE(a.fMe.matrix() == b.fMe.matrix());
  EXPECT_FALSE(a.hooks[0].fMo.matrix() == c.hooks[0].fMo.matrix());
}

TEST(CellWorld, CallbacksComeExactlyOnTheirInstants) {
  CellWorld world(quietCell());
  std::vector<std::int64_t> ms;
  const int id = world.every(0.020, 0.005, [&](Time t) {
    EXPECT_EQ(t, world.time());
    EXPECT_EQ(t.nanoseconds() % 1000000, 0);
    ms.push_back(t.nanoseconds() / 1000000);
  });
  world.advanceTo(Time::fromSeconds(0.050));
  world.setPeriod(id, 0.010);
  world.advanceTo(Time::fromSeconds(0.070));
  EXPECT_EQ(ms, (std::vector<std::int64_t>{5, 25, 45, 55, 65}));
}

TEST(CellWorld, RefusesToBeAdvancedFromItsOwnCallback) {
  CellWorld world(quietCell());
  world.every(0.01, 0.01, [&](Time t) { world.advanceTo(t + 0.1); });
  EXPECT_THROW(world.advanceTo(Time::fromSeconds(0.02)), Error);
}

TEST(CellWorld, RefusesAnImpossibleCell) {
  CellOptions options;
  options.hook.count = 0;
  EXPECT_THROW(CellWorld world(options), InputError);
  options = CellOptions{};
  options.ring.clearance = -0.01;
  EXPECT_THROW(CellWorld world(options), InputError);
}

TEST(CellWorld, ArmErrorMovesTheRingByAboutThatOfTheRealArm) {
  CellOptions options = quietCell();
  options.arm.zero_error_sigma = CellOptions{}.arm.zero_error_sigma;
  const JointVector place =
      jointsForRing(options, shifted(0.42, 0.0, 0.607), options.arm.initial_joints);
  options.arm.initial_joints = place;
  options.belt.start_y = options.belt.entry_y = -1.0;
  double sum = 0.0;
  constexpr int kSeeds = 40;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed);
    const CellWorld world(options);
    const Pose nominal = ringFromJoints(options, world.jointReading());
    sum += (truth(world).fMr.translation() - nominal.translation()).squaredNorm() / 3.0;
  }
  const double rms = std::sqrt(sum / kSeeds);
  std::printf("arm error per axis: %.4f mm rms over %d seeds\n", 1e3 * rms, kSeeds);
  EXPECT_NEAR(rms, 0.18e-3, 0.04e-3);
}

TEST(CellWorld, PhysicsSpeedIsPrinted) {
  CellWorld world{CellOptions{}};
  world.setGripper(true);
  const std::clock_t start = std::clock();
  world.advanceTo(Time::fromSeconds(4.0));
  const double cpu = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("physics: %.1f times real time on one core\n", 4.0 / cpu);
  EXPECT_EQ(world.time(), Time::fromSeconds(4.0));
}

TEST(Truth, CountsPassagesThroughTheRing) {
  const std::vector<Eigen::Vector3d> through{{0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}};
  const std::vector<Eigen::Vector3d> beside{{0.1, 0.0, -1.0}, {0.1, 0.0, 1.0}};
  const std::vector<Eigen::Vector3d> in_and_out{
      {0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}, {0.01, 0.0, 1.0}, {0.01, 0.0, -1.0}};
  EXPECT_EQ(crossings(through, 0.02), 1);
  EXPECT_EQ(crossings(beside, 0.02), 0);
  EXPECT_EQ(crossings(in_and_out, 0.02), 0);
}

}  // namespace
}  // namespace ringhook
