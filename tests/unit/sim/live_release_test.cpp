// Grip, release and hanging with the longer physics step of a cell in real time: what the usual
// step says in insertion_test.cpp it has to say as well.

#include <gtest/gtest.h>

#include "scripted_arm.h"
#include "sim/cell_server.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

CellOptions liveCell(const Pose& oMr) {
  CellOptions options = standingCell(oMr);
  options.physics_step = kLivePhysicsStep;
  options.ring.count = 1;
  return options;
}

RingTruth releaseAt(const Pose& oMr) {
  CellWorld world(liveCell(oMr));
  world.setGripper(true);
  world.advanceTo(Time::fromSeconds(0.2));
  EXPECT_EQ(truth(world).held_ring, 0);
  EXPECT_NEAR(truth(world).grip_force, 0.31, 0.03);
  world.setGripper(false);
  world.advanceTo(Time::fromSeconds(2.2));
  return truth(world).rings[0];
}

TEST(LiveStep, ARingOverTheTipHangsTwoSecondsLater) {
  const RingTruth ring = releaseAt(shifted(0.0, 0.035, 0.007));
  EXPECT_TRUE(ring.hanging);
  EXPECT_FALSE(ring.touching_gripper);
  EXPECT_NEAR(ring.hook_force, 0.31, 0.08) << "its weight of 32 g";
}

TEST(LiveStep, ARingBesideTheTipFallsToTheFloor) {
  const RingTruth ring = releaseAt(shifted(0.0, 0.115, 0.007));
  EXPECT_FALSE(ring.hanging);
  EXPECT_LT(ring.fMr.translation().z(), 0.05);
  EXPECT_GT(ring.fMr.translation().z(), 0.0);
}

TEST(LiveStep, TheArmHoldsItsSetPoint) {
  CellWorld world(liveCell(shifted(-0.1, 0.035, 0.05)));
  world.setGripper(true);
  JointVector expected = world.jointReading();
  const JointVector velocity = JointVector::Constant(0.1);
  for (int tick = 0; tick < 100; ++tick) {
    world.setJointVelocity(velocity, 0.004);
    world.advanceTo(world.time() + 0.004);
    expected += 0.004 * velocity;
  }
  EXPECT_LT((world.jointReading() - expected).cwiseAbs().maxCoeff(), 5e-6);
}

}  // namespace
}  // namespace ringhook
