#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "robot/rx60/kinematics.h"
#include "scripted_arm.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

RingTruth releaseAt(const Pose& oMr) {
  CellWorld world(standingCell(oMr));
  SimArm arm(world);
  arm.setGripper(true);
  world.advanceTo(Time::fromSeconds(0.2));
  EXPECT_EQ(truth(world).held_ring, 0);
  arm.setGripper(false);
  world.advanceTo(Time::fromSeconds(2.2));
  return truth(world).rings[0];
}

TEST(Release, ARingOverTheTipHangsTwoSecondsLater) {
  const RingTruth ring = releaseAt(shifted(0.0, 0.035, 0.007));
  EXPECT_TRUE(ring.hanging);
  EXPECT_EQ(ring.linked_hook, 0);
  EXPECT_FALSE(ring.touching_gripper);
  EXPECT_NEAR(ring.hook_force, 0.31, 0.08) << "its weight of 32 g";
}

TEST(Release, ARingBesideTheTipFallsToTheFloor) {
  const RingTruth ring = releaseAt(shifted(0.0, 0.115, 0.007));
  EXPECT_FALSE(ring.hanging);
  EXPECT_EQ(ring.linked_hook, -1);
  EXPECT_LT(ring.fMr.translation().z(), 0.05);
  EXPECT_GT(ring.fMr.translation().z(), 0.0);
}

TEST(Release, TheFallIsFree) {
  CellWorld world(standingCell(shifted(0.0, 0.115, 0.007)));
  world.setGripper(true);
  world.advanceTo(Time::fromSeconds(0.2));
  const Eigen::Vector3d start = truth(world).rings[0].fMr.translation();
  world.setGripper(false);
  double touched = 0.0;
  for (int i = 0; i < 160; ++i) {
    world.advanceTo(world.time() + 0.0005);
    touched += truth(world).rings[0].touching_gripper ? 1.0 : 0.0;
  }
  const Eigen::Vector3d fallen = truth(world).rings[0].fMr.translation() - start;
  EXPECT_EQ(touched, 0.0);
  EXPECT_NEAR(fallen.z(), -0.5 * 9.81 * 0.08 * 0.08, 0.3e-3);
  EXPECT_LT(fallen.head<2>().norm(), 0.05e-3);
}

TEST(Release, JawsThatHardlyOpenHinderTheFall) {
  CellOptions options = standingCell(shifted(0.0, 0.115, 0.007));
  options.gripper.opening_angle = 0.02;
  CellWorld world(options);
  world.setGripper(true);
  world.advanceTo(Time::fromSeconds(0.2));
  const double start = truth(world).rings[0].fMr.translation().z();
  world.setGripper(false);
  bool touched = false;
  for (int i = 0; i < 160; ++i) {
    world.advanceTo(world.time() + 0.0005);
    touched = touched || truth(world).rings[0].touching_gripper;
  }
  EXPECT_TRUE(touched);
  EXPECT_GT(truth(world).rings[0].fMr.translation().z() - start, -0.5 * 9.81 * 0.08 * 0.08 + 2e-3);
}

TEST(Release, AHeldRingCountsNeitherAsHangingNorAsReleased) {
  CellWorld world(standingCell(shifted(0.0, 0.035, 0.007)));
  world.setGripper(true);
  world.advanceTo(Time::fromSeconds(0.5));
  const CellTruth now = truth(world);
  EXPECT_TRUE(now.rings[0].held);
  EXPECT_EQ(now.rings[0].linked_hook, 0);
  EXPECT_FALSE(now.rings[0].hanging);
  EXPECT_NEAR(now.grip_force, 0.31, 0.03);
}

TEST(Feeder, GivesNoRingNearAHook) {
  CellOptions options = standingCell(shifted(0.0, 0.035, 0.007));
  options.gripper.feeder_clearance = 0.2;
  CellWorld world(options);
  world.setGripper(true);
  EXPECT_EQ(truth(world).held_ring, -1);
  EXPECT_TRUE(world.gripperClosed());
}

TEST(Feeder, ClosesOnNothingOnceTheMagazineIsEmpty) {
  CellOptions options;
  options.ring.count = 1;
  CellWorld world(options);
  world.setGripper(true);
  EXPECT_EQ(truth(world).held_ring, 0);
  world.setGripper(false);
  world.advanceTo(Time::fromSeconds(1.0));
  world.setGripper(true);
  EXPECT_EQ(truth(world).held_ring, -1);
}

TEST(Insertion, AMovingSwingingHookKeepsItsRing) {
  CellOptions options;
  options.hook.count = 1;
  CellWorld world(options);
  ScriptedArm arm(world, 0);
  arm.arm().setGripper(true);
  while (truth(world).hooks[0].fMp.translation().y() < -0.20) {
    arm.rest(0.02);
  }
  double grip_offset = 0.0;
  const auto watch = [&] {
    const CellTruth now = truth(world);
    if (now.held_ring >= 0) {
      const double offset = (now.rings[0].fMr.translation() - now.fMr.translation()).norm();
      grip_offset = std::max(grip_offset, offset);
    }
  };
  insertRing(arm, watch);
  arm.rest(2.0);
  const RingTruth ring = truth(world).rings[0];
  std::printf("ring in grip within %.4f mm, contact before release %.3f N\n", 1e3 * grip_offset,
              ring.peak_force_in_grip);
  EXPECT_TRUE(ring.hanging);
  EXPECT_LT(ring.peak_force_in_grip, 5.0);
  EXPECT_LT(grip_offset, 0.05e-3);
}

TEST(Insertion, TheRingFollowsItsSetPathAtBeltSpeed) {
  CellOptions options;
  options.arm.zero_error_sigma = 0.0;
  CellWorld world(options);
  SimArm arm(world);
  arm.setGripper(true);
  JointVector set = world.jointReading();
  const Pose start = ringFromJoints(options, set);
  double worst = 0.0;
  for (int i = 1; i <= 250; ++i) {
    const Pose goal = shifted(0.0, 0.2 * 0.004 * i, 0.0) * start;
    const JointVector next = jointsForRing(options, goal, set);
    arm.commandVelocity((next - set) / SimArm::kPeriod);
    set = next;
    static_cast<void>(arm.waitState());
    const CellTruth now = truth(world);
    worst = std::max(worst, (now.rings[0].fMr.translation() - goal.translation()).norm());
  }
  std::printf("tracking error of the ring at 0.2 m/s: %.5f mm\n", 1e3 * worst);
  EXPECT_LT(worst, 0.05e-3);
}

}  // namespace
}  // namespace ringhook
