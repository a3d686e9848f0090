#include "sim/sim_arm.h"
#include "core/angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

/// Flange by the product of the modified DH rows of the RX60's data sheet, written out here.
Pose flangeByHand(const JointVector& q) {
  const double h = 0.5 * std::numbers::pi;
  const double rows[6][4] = {{0.0, 0.0, 0.341, 0.0}, {-h, 0.0, 0.0, -h},  {0.0, 0.290, 0.049, h},
                             {h, 0.0, 0.310, 0.0},   {-h, 0.0, 0.0, 0.0}, {h, 0.0, 0.065, 0.0}};
  Eigen::Matrix4d product = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 6; ++i) {
    const double ca = std::cos(rows[i][0]);
    const double sa = std::sin(rows[i][0]);
    const double ct = std::cos(q[i] + rows[i][3]);
    const double st = std::sin(q[i] + rows[i][3]);
    Eigen::Matrix4d row;
    row << ct, -st, 0.0, rows[i][1], st * ca, ct * ca, -sa, -sa * rows[i][2], st * sa, ct * sa, ca,
        ca * rows[i][2], 0.0, 0.0, 0.0, 1.0;
    product = product * row;
  }
  return Pose(product);
}

CellOptions exactArm() {
  CellOptions options;
  options.hook.count = 1;
  options.ring.count = 1;
  options.arm.zero_error_sigma = 0.0;
  return options;
}

TEST(SimArm, FlangeIsWhereTheDataSheetPutsIt) {
  CellOptions options = exactArm();
  options.belt.start_y = options.belt.entry_y = -3.0;
  const double samples[3][6] = {
      {0, 0, 0, 0, 0, 0}, {0.3, -0.4, 1.2, 0.5, -0.7, 2.0}, {-1.1, 0.8, -1.5, -2.0, 1.1, -0.4}};
  for (const auto& sample : samples) {
    options.arm.initial_joints = Eigen::Map<const JointVector>(sample);
    const CellWorld world(options);
    const Pose expected = flangeByHand(options.arm.initial_joints);
    EXPECT_TRUE(truth(world).fMe.isApprox(expected, 1e-9));
  }
  options.arm.initial_joints.setZero();
  EXPECT_NEAR(truth(CellWorld(options)).fMe.translation().z(), 1.006, 1e-9);
}

TEST(SimArm, LateStatesTellWhereTheJointsWereThatMuchBefore) {
  constexpr double kDelay = 0.00523;  // no whole number of physics steps
  CellWorld prompt_world(exactArm());
  CellWorld late_world(exactArm());
  SimArm prompt(prompt_world);
  SimArm late(late_world, kDelay);
  JointVector speed = JointVector::Zero();
  for (int i = 0; i < 50; ++i) {
    const ArmState now = prompt.waitState();
    const ArmState then = late.waitState();
    ASSERT_EQ(now.time, then.time);
    if (i > 20) {  // both have turned evenly for long enough
      const double behind = (now.position[0] - then.position[0]) / speed[0];
      EXPECT_NEAR(behind, kDelay, 1e-6);
      EXPECT_NEAR(then.velocity[0], speed[0], 1e-4);
    }
    speed[0] = 0.3;
    prompt.commandVelocity(speed);
    late.commandVelocity(speed);
  }
}

TEST(SimArm, RefusesAVelocityBeyondAJointsRange) {
  CellOptions options = exactArm();
  options.arm.initial_joints[4] = 120.4 * kDegree;
  CellWorld world(options);
  SimArm arm(world);
  JointVector command = JointVector::Zero();
  command[4] = 1.0;
  EXPECT_THROW(arm.commandVelocity(command), DeviceError);
}

TEST(SimArm, DoesNotKnowItsOwnKinematicError) {
  CellOptions options = exactArm();
  options.arm.zero_error_sigma = CellOptions{}.arm.zero_error_sigma;
  CellWorld world(options);
  SimArm arm(world);
  const ArmState state = arm.waitState();
  EXPECT_LT((state.position - options.arm.initial_joints).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_GT((truth(world).fMe.translation() - flangeByHand(state.position).translation()).norm(),
            2e-5);
}

}  // namespace
}  // namespace ringhook
