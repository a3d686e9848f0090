#include "arm_contract.h"

#include <cmath>
#include <limits>

#include "core/error.h"
#include "robot/rx60/kinematics.h"

namespace ringhook {

ArmState ArmContract::drive(const JointVector& joint_velocity, int periods) {
  ArmState state = arm().waitState();
  for (int i = 0; i < periods; ++i) {
    arm().commandVelocity(joint_velocity);
    state = arm().waitState();
  }
  return state;
}

void ArmContract::wakeUp() {
  static_cast<void>(drive(JointVector::Zero(), held_->periodsToWakeUp()));
}

ArmState ArmContract::rest() { return idle(held_->periodsToRest()); }

ArmState ArmContract::idle(int periods) {
  ArmState state = arm().waitState();
  for (int i = 1; i < periods; ++i) {
    state = arm().waitState();
  }
  return state;
}

void ArmContract::tryCommand(const JointVector& joint_velocity) {
  try {
    arm().commandVelocity(joint_velocity);
  } catch (const DeviceError&) {
    SUCCEED();
  }
}

namespace {

constexpr double kPeriod = 0.004;

JointVector slow() { return JointVector{{0.1, -0.1, 0.1, 0.2, -0.1, 0.2}}; }

double moved(const ArmState& from, const ArmState& to) {
  return (to.position - from.position).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_P(ArmContract, StatesComeEveryFourMilliseconds) {
  const ArmState first = arm().waitState();
  const ArmState later = idle(10);
  EXPECT_NEAR(later.time - first.time, 10 * kPeriod, 0.5 * kPeriod);
  EXPECT_TRUE(later.motion_possible);
}

TEST_P(ArmContract, ACommandedVelocityIsFollowed) {
  wakeUp();
  const ArmState start = arm().waitState();
  const ArmState end = drive(slow(), 25);
  const JointVector expected = slow() * 25 * kPeriod;
  const double late = 0.2 * kPeriod * (0.1 + held().periodsToFollow());
  EXPECT_LT((end.position - start.position - expected).cwiseAbs().maxCoeff(), late);
  ArmState later = end;
  for (int i = 0; i < 25; ++i) {
    arm().commandVelocity(slow());
    later = arm().waitState();
  }
  EXPECT_LT((later.position - end.position - expected).cwiseAbs().maxCoeff(), 1e-4)
      << "once followed it is followed exactly";
}

TEST_P(ArmContract, ACommandActsAfterTheDelayThatIsStated) {
  wakeUp();
  const ArmState start = drive(JointVector::Zero(), 3);
  int periods = 0;
  ArmState state = start;
  while (moved(start, state) < 1e-9 && periods < 20) {
    arm().commandVelocity(slow());
    state = arm().waitState();
    ++periods;
  }
  // The period in which it moved ends with the state in which that shows.
  EXPECT_NEAR((periods - 1) * kPeriod, arm().commandDelay(), 1e-9);
}

TEST_P(ArmContract, TheStatesVelocityIsThePositionsChange) {
  wakeUp();
  static_cast<void>(drive(slow(), 20));
  arm().commandVelocity(slow());
  const ArmState before = arm().waitState();
  arm().commandVelocity(slow());
  const ArmState after = arm().waitState();
  const JointVector expected = (after.position - before.position) / (after.time - before.time);
  EXPECT_LT((after.velocity - expected).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_P(ArmContract, ACommandEndsByItself) {
  wakeUp();
  static_cast<void>(drive(slow(), 20));
  const ArmState settled = rest();
  const ArmState later = idle(10);
  EXPECT_LT(moved(settled, later), 1e-6);
}

TEST_P(ArmContract, StopStandsUntilRearmed) {
  wakeUp();
  static_cast<void>(drive(slow(), 10));
  arm().stop();
  const ArmState stopped = idle(4);
  EXPECT_FALSE(stopped.motion_possible);
  tryCommand(slow());
  const ArmState later = idle(20);
  EXPECT_LT(moved(stopped, later), 1e-6);
  arm().rearm();
  const ArmState standing = idle(20);
  EXPECT_LT(moved(later, standing), 1e-6) << "permission is not motion";
  wakeUp();
  const ArmState again = drive(slow(), 10);
  EXPECT_GT(moved(standing, again), 1e-3);
}

TEST_P(ArmContract, ANonFiniteCommandStopsTheArm) {
  wakeUp();
  static_cast<void>(drive(slow(), 10));
  JointVector bad = slow();
  bad[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(arm().commandVelocity(bad), DeviceError);
  const ArmState stopped = idle(4);
  tryCommand(slow());
  const ArmState later = idle(20);
  EXPECT_TRUE(later.position.allFinite());
  EXPECT_LT(moved(stopped, later), 1e-6);
}

TEST_P(ArmContract, ACommandBeyondTheSpeedLimitStopsTheArm) {
  wakeUp();
  JointVector fast = JointVector::Zero();
  fast[0] = 5.1;  // 292 degrees per second; joint 1 is good for 287
  EXPECT_THROW(arm().commandVelocity(fast), DeviceError);
  const ArmState stopped = idle(4);
  const ArmState later = idle(20);
  EXPECT_LT(moved(stopped, later), 1e-6);
  EXPECT_FALSE(later.motion_possible);
}

TEST_P(ArmContract, NoRunOfCommandsLeavesTheJointRanges) {
  wakeUp();
  const JointLimits limits = rx60::limits();
  JointVector towards = JointVector::Zero();
  towards[4] = 1.0;  // joint 5 has the nearest limit
  for (int k = 0; k < 1500; ++k) {
    try {
      arm().commandVelocity(towards);
    } catch (const DeviceError&) {
      break;  // an arm may also refuse
    }
    static_cast<void>(arm().waitState());
  }
  const double reached = arm().waitState().position[4];
  EXPECT_LE(reached, limits.upper[4] + 1e-6);
  EXPECT_GT(reached, limits.upper[4] - 0.05) << "it went as far as it may";
}

TEST_P(ArmContract, TheGripperCanBeWorkedWhileStanding) {
  static_cast<void>(arm().waitState());
  arm().setGripper(true);
  const ArmState start = idle(1);
  arm().setGripper(false);
  EXPECT_LT(moved(start, idle(10)), 1e-5);
}

}  // namespace ringhook
