// The RX60's client keeps the contract of every Arm, speaking its protocol to the simulated
// controller in virtual time; and what holds for it alone.

#include "robot/rx60/rx60_arm.h"

#include <gmock/gmock.h>

#include "arm_contract.h"
#include "core/error.h"
#include "sim/controller_port.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

JointVector wellInside() { return JointVector{{0.3, 0.4, 0.9, -0.2, 0.8, 0.1}}; }

/// Controller, wire and client, all in virtual time.
class Rx60ArmUnderTest : public ArmUnderTest {
 public:
  explicit Rx60ArmUnderTest(const Rx60ControllerOptions& options = {})
      : controller_(plant_, options) {
    auto port = std::make_unique<ControllerPort>(controller_, plant_);
    port_ = port.get();
    unconnected_ = std::move(port);
  }
  Arm& arm() override { return client(); }
  [[nodiscard]] int periodsToWakeUp() const override { return 20; }
  [[nodiscard]] int periodsToFollow() const override { return 6; }
  [[nodiscard]] int periodsToRest() const override { return 90; }

  /// Connects when first asked for.
  Rx60Arm& client() {
    if (!arm_) {
      arm_.emplace(std::move(unconnected_), rx60::LinkSettings(), Rx60Arm::Runs::kInWaitState);
    }
    return *arm_;
  }
  Rx60Controller& controller() { return controller_; }
  ControllerPort& port() { return *port_; }
  KinematicPlant& plant() { return plant_; }

 private:
  KinematicPlant plant_{wellInside()};
  Rx60Controller controller_;
  std::unique_ptr<ControllerPort> unconnected_;
  ControllerPort* port_ = nullptr;
  std::optional<Rx60Arm> arm_;
};

std::unique_ptr<ArmUnderTest> makeRx60Arm() { return std::make_unique<Rx60ArmUnderTest>(); }

INSTANTIATE_TEST_SUITE_P(Rx60OverItsProtocol, ArmContract, ::testing::Values(&makeRx60Arm));

/// Answers `periods` states with this velocity [rad/s].
void drive(Rx60Arm& arm, const JointVector& velocity, int periods) {
  for (int k = 0; k < periods; ++k) {
    static_cast<void>(arm.waitState());
    arm.commandVelocity(velocity);
  }
}

JointVector slow() { return JointVector{{0.1, -0.1, 0.1, 0.2, -0.1, 0.2}}; }

/// What the client says when a state is waited for until something goes wrong.
std::string failureOf(Rx60Arm& arm, int periods) {
  try {
    for (int k = 0; k < periods; ++k) {
      static_cast<void>(arm.waitState());
    }
  } catch (const DeviceError& e) {
    return e.what();
  }
  return "nothing went wrong";
}

TEST(Rx60Arm, MissesNoTickWhileATargetOf50HzIsServed) {
  Rx60ArmUnderTest held;
  Rx60Arm& arm = held.client();
  drive(arm, slow(), 20);
  const Rx60Counts before = held.controller().counts();
  for (int k = 0; k < 2500; ++k) {
    static_cast<void>(arm.waitState());
    if (k % 5 == 0) {  // vision: every fifth period
      arm.commandVelocity(k / 250 % 2 == 0 ? slow() : -slow());
    }
  }
  const Rx60Counts after = held.controller().counts();
  EXPECT_EQ(after.velocity_ticks - before.velocity_ticks, 2500);
  EXPECT_EQ(after.missed_ticks - before.missed_ticks, 0);
}

TEST(Rx60Arm, WorksOffABacklogThatAHiccupLeft) {
  Rx60ArmUnderTest held;
  Rx60Arm& arm = held.client();
  drive(arm, slow(), 20);
  const rx60::VelocityCmd extra;  // one message more than ticks, ahead of all that follow
  for (int k = 0; k < 2; ++k) {
    held.port().write(
        rx60::Channel::kMotion,
        rx60::encode({rx60::CommType::kTopic, rx60::ReplyCode::kNone, extra}).bytes());
  }
  drive(arm, slow(), 10);
  EXPECT_GE(held.controller().waitingBytes(Rx60Socket::kMotion), 2 * 48U) << "it stands";
  drive(arm, slow(), 150);
  EXPECT_LT(held.controller().waitingBytes(Rx60Socket::kMotion), 2 * 48U);
  EXPECT_EQ(arm.report().left_out, 2);
}

TEST(Rx60Arm, AcceptsThatCommandsAreUnderWayOnALongWire) {
  Rx60ArmUnderTest held;
  LineFaults late;
  late.delay = 0.005;
  held.port().toController(Rx60Socket::kMotion).setFaults(late);
  held.port().toClient(Rx60Socket::kMotion).setFaults(late);
  Rx60Arm& arm = held.client();
  drive(arm, slow(), 1000);
  EXPECT_LE(arm.report().left_out, 3) << "tried once for each command under way";
  EXPECT_GE(arm.report().left_out, 1);
}

TEST(Rx60Arm, TheGripperIsTheConfiguredOutput) {
  Rx60ArmUnderTest held;
  Rx60Arm& arm = held.client();
  arm.setGripper(true);
  drive(arm, JointVector::Zero(), 5);
  EXPECT_TRUE(held.plant().output(2, 0));
  arm.setGripper(false);
  drive(arm, JointVector::Zero(), 5);
  EXPECT_FALSE(held.plant().output(2, 0));
}

TEST(Rx60Arm, AnEStopThrowsAndNothingMovesUntilRearm) {
  Rx60ArmUnderTest held;
  Rx60Arm& arm = held.client();
  drive(arm, slow(), 40);
  held.controller().pressEStop();
  EXPECT_THAT(failureOf(arm, 50), HasSubstr("emergency stop"));
  EXPECT_THROW(arm.rearm(), DeviceError) << "still pressed";
  held.controller().releaseEStop();
  held.controller().setDrives(true);
  EXPECT_THROW(arm.commandVelocity(slow()), DeviceError);
  const JointVector standing = held.plant().position();
  arm.rearm();
  drive(arm, JointVector::Zero(), 30);
  EXPECT_EQ(held.plant().position(), standing);
  drive(arm, slow(), 40);
  EXPECT_GT((held.plant().position() - standing).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(Rx60Arm, ACutConnectionIsNamedAndRearmConnectsAnew) {
  Rx60ArmUnderTest held;
  Rx60Arm& arm = held.client();
  drive(arm, slow(), 40);
  held.port().cut(Rx60Socket::kMotion);
  EXPECT_THAT(failureOf(arm, 50), HasSubstr("closed the motion connection"));
  const JointVector standing = held.plant().position();
  arm.rearm();
  EXPECT_EQ(held.port().openings(), 2);
  drive(arm, JointVector::Zero(), 30);
  EXPECT_LT((held.plant().position() - standing).cwiseAbs().maxCoeff(), 1.01 * 0.2 * 0.004)
      << "the tick in which the connection was cut";
  drive(arm, slow(), 40);
  EXPECT_GT((held.plant().position() - standing).cwiseAbs().maxCoeff(), 1e-2);
}

TEST(Rx60Arm, AServerWithoutVelocityControlIsRefusedAtOnce) {
  Rx60ControllerOptions options;
  options.velocity_addon = false;
  Rx60ArmUnderTest held(options);
  try {
    static_cast<void>(held.client());
    FAIL() << "expected DeviceError";
  } catch (const DeviceError& e) {
    EXPECT_THAT(e.what(), HasSubstr("velocity extension"));
  }
}

TEST(Rx60Arm, AControllerThatCannotBeReachedIsNamed) {
  Rx60ArmUnderTest held;
  held.port().refuseOpening(1);
  EXPECT_THROW(static_cast<void>(held.client()), DeviceError);
}

TEST(Rx60Arm, ACoarseMoveArrivesAndServingGoesOn) {
  Rx60ArmUnderTest held;
  Rx60Arm& arm = held.client();
  const JointVector start = held.plant().position();
  const JointVector goal = start + JointVector{{0.2, -0.1, 0.1, 0.3, -0.2, 0.1}};
  std::vector<rx60::JointPoint> points;
  for (int k = 1; k <= 15; ++k) {  // more than the controller's queue holds
    points.push_back({start + k / 15.0 * (goal - start), 0.3});
  }
  arm.startMove(points);
  int periods = 0;
  while (arm.moving() && periods < 5000) {
    static_cast<void>(arm.waitState());
    ++periods;
  }
  EXPECT_LT((held.plant().position() - goal).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_GT(held.controller().counts().refused, 0) << "the queue was full, points were sent again";
  drive(arm, slow(), 60);
  EXPECT_GT((held.plant().position() - goal).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(Rx60Arm, LeavesTheArmStandingWhenItGoes) {
  Rx60ArmUnderTest held;
  KinematicPlant plant(wellInside());
  Rx60Controller controller(plant);
  {
    Rx60Arm arm(std::make_unique<ControllerPort>(controller, plant), rx60::LinkSettings(),
                Rx60Arm::Runs::kInWaitState);
    drive(arm, slow(), 60);
    EXPECT_NE(controller.commandedVelocity(), JointVector::Zero());
  }
  controller.tick(Time::fromSeconds(1000.0));
  controller.tick(Time::fromSeconds(1000.004));
  EXPECT_EQ(controller.commandedVelocity(), JointVector::Zero());
}

}  // namespace
}  // namespace ringhook
