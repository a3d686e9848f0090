// The arm that a calibrated rig belongs to, where the loop uses it.

#include "cycle/arm_motion.h"

#include <gtest/gtest.h>

#include "default_cell.h"
#include "robot/rx60/kinematics.h"

namespace ringhook {
namespace {

StereoRig rigWithZeros() {
  StereoRig rig;
  rig.joint_zeros_rad << 0.0, 0.004, -0.003, 0.002, 0.005, 0.0;
  return rig;
}

TEST(ArmMotion, HasTheRingWhereTheCorrectedJointsPutIt) {
  const CellConfig cell = test::defaultCell();
  const StereoRig rig = rigWithZeros();
  const JointVector q = cell.arm.standby_rad;
  const Pose wanted = rx60::forward(rx60::rx60(), q + rig.joint_zeros_rad) * cell.arm.eMr;
  EXPECT_TRUE(ArmMotion(cell, armOf(rig)).ringPose(q).isApprox(wanted, 1e-12));
  EXPECT_FALSE(ArmMotion(cell, rx60::rx60()).ringPose(q).isApprox(wanted, 1e-4));
}

TEST(ArmMotion, ArrivesWhereReportedJointsWereAsked) {
  const CellConfig cell = test::defaultCell();
  ArmMotion motion(cell, armOf(rigWithZeros()));
  ArmState state;
  state.position = cell.arm.load_rad;
  state.velocity.setZero();
  state.motion_possible = true;
  for (int tick = 0; tick < 5000 && !motion.arrived(state); ++tick) {
    const auto velocity = motion.moveTo(state, cell.arm.standby_rad);
    ASSERT_TRUE(velocity) << velocity.reason();
    state.position += kArmPeriod * *velocity;
    state.time = state.time + kArmPeriod;
  }
  EXPECT_TRUE(motion.arrived(state));
  EXPECT_LT((state.position - cell.arm.standby_rad).cwiseAbs().maxCoeff(), 2e-3);
}

}  // namespace
}  // namespace ringhook
