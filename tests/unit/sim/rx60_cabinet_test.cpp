// The simulated controller's other sockets, its cabinet and the server without the extension.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "robot/rx60/kinematics.h"
#include "rx60_bytes.h"

namespace ringhook {
namespace {

using namespace test;

constexpr auto kMotion = Rx60Socket::kMotion;
constexpr auto kState = Rx60Socket::kState;
constexpr auto kSystem = Rx60Socket::kSystem;
constexpr auto kIo = Rx60Socket::kIo;

class Rx60Cabinet : public ::testing::Test, protected ControllerBench {
 protected:
  /// The next STATUS on the wire.
  Sent nextStatus() {
    run(20);
    const std::vector<Sent> frames = sent(kState);
    const auto found = std::find_if(frames.begin(), frames.end(),
                                    [](const Sent& frame) { return frame.type == 13; });
    return found == frames.end() ? Sent() : *found;
  }
};

TEST_F(Rx60Cabinet, StatusTellsThatMotionIsPossible) {
  makeReady();
  const Sent status = nextStatus();
  ASSERT_EQ(status.body.size(), 28U);
  const std::vector<std::int32_t> expected = {1, 0, 0, 0, 0, 2, 1};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(status.i32(4 * i), expected[i]) << "field " << i;
  }
}

TEST_F(Rx60Cabinet, StatusTellsOfMotionAndPendant) {
  makeReady();
  controller.setPendantMode(rx60::PendantMode::kManual);
  send(kMotion, trajectoryPoint(1, {1.0}, 0.1));
  const Sent status = nextStatus();
  EXPECT_EQ(status.i32(16), 1);
  EXPECT_EQ(status.i32(20), 1);
  controller.setPendantMode(rx60::PendantMode::kUnknown);
  EXPECT_EQ(nextStatus().i32(20), -1);
}

TEST_F(Rx60Cabinet, EStopStopsWithinTheTickAndTakesTheDrives) {
  makeVelocityReady();
  send(kMotion, velocityCmd(1, {0.5}));
  run();
  controller.pressEStop();
  run(2);
  EXPECT_EQ(plant.position()[0], 0.0);
  const Sent status = nextStatus();
  EXPECT_EQ(status.i32(0), 0) << "drives";
  EXPECT_EQ(status.i32(4), 1) << "e-stop";
  EXPECT_EQ(status.i32(24), 0) << "motion possible";
  send(kMotion, velocityCmd(2, {0.5}, kRequest));
  run();
  EXPECT_EQ(sent(kMotion).back().reply, 2);
}

TEST_F(Rx60Cabinet, AfterAnEStopTheDrivesAreAskedForAndMotionReturnsWithAStatus) {
  makeVelocityReady();
  controller.pressEStop();
  nextStatus();
  send(kSystem, drivePower(true));
  run();
  EXPECT_EQ(sent(kSystem).back().reply, 1) << "the server says so whatever the drives do";
  EXPECT_FALSE(controller.drivesOn());
  controller.releaseEStop();
  EXPECT_EQ(nextStatus().i32(0), 0) << "still off";
  send(kSystem, drivePower(true));
  run();
  EXPECT_TRUE(controller.drivesOn());
  EXPECT_EQ(nextStatus().i32(24), 1);
  send(kMotion, velocityCmd(3, {0.5}));
  run(2);
  EXPECT_GT(plant.position()[0], 0.0);
}

TEST_F(Rx60Cabinet, DrivesOffForgetsAMoveUnderWay) {
  makeReady();
  send(kMotion, trajectoryPoint(1, {1.0}, 0.1));
  run(20);
  send(kSystem, drivePower(false));
  run();
  const JointVector stopped = plant.position();
  controller.setDrives(true);
  run(50);
  EXPECT_EQ(plant.position(), stopped);
}

TEST_F(Rx60Cabinet, ErrorKillsTheMotionTaskAndIsReported) {
  makeVelocityReady();
  send(kMotion, velocityCmd(1, {0.5}));
  run();
  controller.setError(40);
  const Sent status = nextStatus();
  EXPECT_EQ(status.i32(8), 40);
  EXPECT_EQ(status.i32(12), 1);
  EXPECT_EQ(status.i32(24), 0);
  EXPECT_EQ(plant.position()[0], 0.0);
  controller.setError(0);
  EXPECT_EQ(nextStatus().i32(24), 1);
}

TEST_F(Rx60Cabinet, OutputsAreSetOnModulesThatExist) {
  makeReady();
  const auto replyTo = [this](const Bytes& request) {
    send(kIo, request);
    run();
    const Sent reply = sent(kIo).back();
    EXPECT_EQ(reply.type, 1621);
    EXPECT_EQ(reply.body, Bytes(9));
    return reply.reply;
  };
  EXPECT_EQ(replyTo(singleIo(2, 1, true)), 1);
  EXPECT_TRUE(plant.output(2, 1));
  EXPECT_EQ(replyTo(singleIo(2, 1, false)), 1);
  EXPECT_FALSE(plant.output(2, 1));
  EXPECT_EQ(replyTo(singleIo(2, 2, true)), 2) << "the arm has two valves";
  EXPECT_EQ(replyTo(singleIo(4, 15, true)), 1);
  EXPECT_EQ(replyTo(singleIo(0, 0, true)), 2) << "modules count from 1";
  EXPECT_EQ(replyTo(singleIo(7, 0, true)), 2);
  EXPECT_EQ(replyTo(singleIo(4, -1, true)), 2);
}

TEST_F(Rx60Cabinet, UnknownTypesAreFlushedWithoutAReply) {
  makeReady();
  send(kMotion, frame(1, kRequest, Bytes(40)));  // PING
  send(kMotion, velocityCfg());
  run(10);
  EXPECT_TRUE(sent(kMotion).empty()) << "the message behind it went the same way";
  EXPECT_FALSE(controller.velocityMode());
  EXPECT_EQ(controller.counts().flushes, 1);
  send(kMotion, velocityCfg());
  run();
  EXPECT_EQ(sent(kMotion).size(), 1U) << "later ones are understood";
}

TEST_F(Rx60Cabinet, StateMessagesFromAClientAreUnknownToo) {
  makeReady();
  for (const auto& [type, size] : {std::pair(10, 44), std::pair(13, 28), std::pair(15, 132)}) {
    send(kMotion, frame(type, kRequest, Bytes(static_cast<std::size_t>(size))));
    run();
  }
  EXPECT_EQ(controller.counts().flushes, 3);
  EXPECT_TRUE(sent(kMotion).empty());
}

TEST_F(Rx60Cabinet, AnnouncedLengthIsNotLookedAt) {
  makeReady();
  Bytes lying = velocityCfg();
  lying[0] = std::byte{99};
  send(kMotion, lying);
  run();
  EXPECT_EQ(sent(kMotion).size(), 1U);
}

TEST_F(Rx60Cabinet, BytesMayTrickleInWithinABody) {
  makeVelocityReady();
  const Bytes command = velocityCmd(1, {0.5});
  send(kMotion, Bytes(command.begin(), command.begin() + 20));
  run(3);
  for (std::size_t i = 20; i < command.size(); ++i) {
    send(kMotion, {command[i]});
    run();
  }
  run(2);
  EXPECT_NEAR(plant.position()[0], 0.5 * Rx60Controller::kTick, 1e-9);
}

TEST_F(Rx60Cabinet, NobodyIsHeardUnlessConnected) {
  send(kSystem, drivePower(false));
  run(2);
  EXPECT_TRUE(controller.drivesOn());
}

TEST(Rx60Master, StreamsJointPositionAt50Hz) {
  ControllerBench bench({.velocity_addon = false});
  bench.makeReady();
  bench.run(500);
  const std::vector<Sent> frames = bench.sent(kState);
  const auto count = [&](std::int32_t type) {
    return std::count_if(frames.begin(), frames.end(),
                         [&](const Sent& frame) { return frame.type == type; });
  };
  EXPECT_EQ(count(10), 100) << "2 s";
  EXPECT_EQ(count(15), 0);
  EXPECT_EQ(count(13), 5);
  EXPECT_EQ(frames.front().body.size(), 44U);
}

TEST(Rx60Master, KnowsNoVelocityMessagesButPoints) {
  ControllerBench bench({.velocity_addon = false});
  bench.makeReady();
  bench.send(kMotion, velocityCfg());
  bench.run(2);
  EXPECT_TRUE(bench.sent(kMotion).empty());
  bench.send(kMotion, trajectoryPoint(1, {0.1}));
  bench.run(100);
  EXPECT_EQ(bench.sent(kMotion).size(), 1U);
  EXPECT_NEAR(bench.plant.position()[0], 0.1, 1e-6);
}

TEST(Rx60JointMove, KeepsSpeedAndAccelerationAndEndsTogether) {
  const JointLimits limits = rx60::limits();
  JointVector goal;
  goal << 1.5, -0.4, 0.0, 0.3, 1.0, -3.0;
  const Rx60JointMove move(JointVector::Zero(), goal, 0.5, limits);
  constexpr double kStep = 1e-3;
  JointVector before = JointVector::Zero();
  JointVector speed_before = JointVector::Zero();
  double fastest = 0.0;
  for (double t = kStep; t < move.duration() + 0.01; t += kStep) {
    const JointVector q = move.position(t);
    const JointVector speed = (q - before) / kStep;
    EXPECT_TRUE((speed.cwiseAbs().array() <= 0.5 * limits.velocity.array() + 1e-9).all());
    const JointVector acceleration = (speed - speed_before) / kStep;
    EXPECT_TRUE((acceleration.cwiseAbs().array() <= limits.acceleration.array() + 1e-6).all());
    EXPECT_NEAR(q[4] * 1.5, q[0], 1e-12) << "a straight line in joint space";
    fastest = std::max(fastest, speed.cwiseAbs().cwiseQuotient(limits.velocity).maxCoeff());
    before = q;
    speed_before = speed;
  }
  EXPECT_NEAR(fastest, 0.5, 1e-6) << "one joint is at its share";
  EXPECT_EQ(before, goal);
}

TEST(Rx60JointMove, ShortWayIsATriangle) {
  const JointLimits limits = rx60::limits();
  JointVector goal = JointVector::Zero();
  goal[0] = 0.01;
  const Rx60JointMove move(JointVector::Zero(), goal, 1.0, limits);
  EXPECT_NEAR(move.duration(), 2.0 * std::sqrt(0.01 / limits.acceleration[0]), 1e-12);
  EXPECT_NEAR(move.position(move.duration() / 2.0)[0], 0.005, 1e-12);
}

TEST(Rx60JointMove, NowhereTakesNoTime) {
  const JointVector here = JointVector::Constant(0.3);
  const Rx60JointMove move(here, here, 1.0, rx60::limits());
  EXPECT_EQ(move.duration(), 0.0);
  EXPECT_EQ(move.position(0.0), here);
}

TEST(KinematicPlant, StopsAtItsLimitAndWithItsDuration) {
  KinematicPlant plant;
  plant.setVelocity(JointVector::Constant(1.0), 0.1);
  plant.advanceTo(Time::fromSeconds(0.05));
  EXPECT_NEAR(plant.position()[2], 0.05, 1e-12);
  plant.advanceTo(Time::fromSeconds(5.0));
  EXPECT_NEAR(plant.position()[2], 0.1, 1e-12);
  plant.setVelocity(JointVector::Constant(5.0), 10.0);
  plant.advanceTo(Time::fromSeconds(15.0));
  EXPECT_EQ(plant.position(), rx60::limits().upper);
}

}  // namespace
}  // namespace ringhook
