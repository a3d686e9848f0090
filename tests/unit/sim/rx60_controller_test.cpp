// The simulated controller against the VAL3 server's behaviour, byte by byte.

#include "sim/rx60_controller.h"
#include "core/angle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "rx60_bytes.h"

namespace ringhook {
namespace {

using namespace test;

constexpr auto kMotion = Rx60Socket::kMotion;
constexpr auto kState = Rx60Socket::kState;
constexpr double kTick = Rx60Controller::kTick;

int countType(const std::vector<Sent>& frames, std::int32_t type) {
  return static_cast<int>(std::count_if(frames.begin(), frames.end(),
                                        [&](const Sent& sent) { return sent.type == type; }));
}

class Rx60State : public ::testing::Test, protected ControllerBench {};

TEST_F(Rx60State, BeginsOneSecondAfterConnecting) {
  controller.connect(kState);
  run(1 + 249);  // the tick that sees the connection, and all but one of the 250 that follow
  EXPECT_TRUE(sent(kState).empty());
  run();
  EXPECT_EQ(sent(kState).size(), 1U);
}

TEST_F(Rx60State, FeedbackComesEveryTickAndStatusBehindEveryTwentieth) {
  controller.connect(kState);
  run(251 + 20);
  const std::vector<Sent> first = sent(kState);
  ASSERT_EQ(first.size(), 22U);
  EXPECT_EQ(countType(first, 15), 21);
  EXPECT_EQ(first.back().type, 13);
  run(20);
  const std::vector<Sent> next = sent(kState);
  ASSERT_EQ(next.size(), 21U);
  EXPECT_EQ(next.back().type, 13);
}

TEST_F(Rx60State, FeedbackHasTheServersLayout) {
  plant.setVelocity(JointVector::Constant(0.5), 1.0);
  makeReady();
  run();
  const Sent feedback = sent(kState).front();
  EXPECT_EQ(feedback.length, 12 + 132);
  EXPECT_EQ(feedback.comm, 1);
  EXPECT_EQ(feedback.reply, 0);
  EXPECT_EQ(feedback.i32(0), 0);
  EXPECT_EQ(feedback.i32(4), 7);
  for (std::size_t joint = 0; joint < 10; ++joint) {
    const double expected = joint < 6 ? plant.position()[static_cast<Eigen::Index>(joint)] : 0.0;
    EXPECT_FLOAT_EQ(static_cast<float>(feedback.f32(12 + 4 * joint)), static_cast<float>(expected));
    EXPECT_EQ(feedback.f32(92 + 4 * joint), 0.0);
  }
}

TEST_F(Rx60State, TimeFieldIsAnIntegersBits) {
  makeReady();
  run(500);
  const Sent feedback = sent(kState).back();
  EXPECT_EQ(feedback.i32(8), 3);  // (275 + 500) ticks are 3.1 s
  EXPECT_LT(feedback.f32(8), 1e-40) << "as a float it is next to nothing";
}

TEST_F(Rx60State, VelocityIsTheCommandedOne) {
  makeVelocityReady();
  send(kMotion, velocityCmd(1, {0.1, 0.2}));
  run(2);
  const Sent after = sent(kState).back();
  EXPECT_FLOAT_EQ(static_cast<float>(after.f32(52)), 0.1F);
  EXPECT_FLOAT_EQ(static_cast<float>(after.f32(56)), 0.2F);
}

TEST_F(Rx60State, StartsOverAfterReconnecting) {
  makeReady();
  controller.disconnect(kState);
  controller.connect(kState);
  run(250);
  EXPECT_TRUE(sent(kState).empty());
  run();
  EXPECT_FALSE(sent(kState).empty());
}

class Rx60Velocity : public ::testing::Test, protected ControllerBench {
 protected:
  [[nodiscard]] double joint1() const { return plant.position()[0]; }
  /// Sends a command and lives its tick to the end.
  void command(double velocity) {
    send(kMotion, velocityCmd(7, {velocity}));
    run(2);
  }
};

TEST_F(Rx60Velocity, LastsOneTick) {
  makeVelocityReady();
  command(0.5);
  EXPECT_NEAR(joint1(), 0.5 * kTick, 1e-9);
  run(10);
  EXPECT_NEAR(joint1(), 0.5 * kTick, 1e-9);
}

TEST_F(Rx60Velocity, OneMessageATickMakesABacklogOfAFasterSender) {
  makeVelocityReady();
  for (int tick = 0; tick < 50; ++tick) {  // 500 Hz
    send(kMotion, velocityCmd(2 * tick, {0.1}));
    send(kMotion, velocityCmd(2 * tick + 1, {0.1}));
    run();
  }
  EXPECT_EQ(controller.waitingBytes(kMotion), 50U * 48U);
  EXPECT_EQ(controller.counts().received.at(rx60::MessageType::kVelocityCmd), 50);
  run(51);
  EXPECT_NEAR(joint1(), 100 * 0.1 * kTick, 1e-6) << "the arm works the backlog off, 0.2 s late";
}

TEST_F(Rx60Velocity, FreeRunning50HzLeavesFourFifthsOfTheTicksAtZero) {
  makeVelocityReady();
  const Rx60Counts before = controller.counts();
  for (int tick = 0; tick < 1000; ++tick) {
    if (tick % 5 == 0) {
      send(kMotion, velocityCmd(tick, {0.1}));
    }
    run();
  }
  EXPECT_EQ(controller.counts().velocity_ticks - before.velocity_ticks, 1000);
  EXPECT_EQ(controller.counts().missed_ticks - before.missed_ticks, 800);
  EXPECT_EQ(controller.counts().zero_ticks - before.zero_ticks, 800);
  run();
  EXPECT_NEAR(joint1(), 0.1 * 4.0 / 5.0, 1e-6) << "a fifth of 0.1 rad/s for 4 s";
}

TEST_F(Rx60Velocity, ConfigurationIsAcknowledgedBeforeTheModeSwitches) {
  makeReady();
  send(kMotion, velocityCfg());
  run();
  const std::vector<Sent> replies = sent(kMotion);
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].type, 1640);
  EXPECT_EQ(replies[0].length, 12 + 68);
  EXPECT_EQ(replies[0].comm, 3);
  EXPECT_EQ(replies[0].reply, 1);
  EXPECT_EQ(replies[0].body, Bytes(68)) << "all zeros";
  EXPECT_FALSE(controller.velocityMode());
  run(3);
  EXPECT_FALSE(controller.velocityMode());
  run();
  EXPECT_TRUE(controller.velocityMode());
}

TEST_F(Rx60Velocity, CommandsDuringTheModeSwitchAreLostButForTheLast) {
  makeReady();
  send(kMotion, velocityCfg());
  run();
  for (const double velocity : {0.5, 0.4, 0.3, 0.2}) {
    send(kMotion, velocityCmd(1, {velocity}, kRequest));
    run();
    EXPECT_EQ(joint1(), 0.0);
  }
  EXPECT_EQ(countType(sent(kMotion), 1641), 4) << "all acknowledged";
  run(10);
  EXPECT_NEAR(joint1(), 0.2 * kTick, 1e-9);
}

TEST_F(Rx60Velocity, ZerosDuringTheModeSwitchMakeItSafe) {
  makeReady();
  send(kMotion, velocityCmd(1, {0.5}));
  run();
  send(kMotion, velocityCfg());
  run();
  send(kMotion, velocityCmd(2, {0.0}));
  run(20);
  EXPECT_EQ(joint1(), 0.0);
}

TEST_F(Rx60Velocity, CommandInTrajectoryModeIsAcknowledgedAndDoesNotMove) {
  makeReady();
  send(kMotion, velocityCmd(42, {0.5}, kRequest));
  run(10);
  const std::vector<Sent> replies = sent(kMotion);
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].reply, 1);
  EXPECT_EQ(replies[0].i32(0), 42) << "the sequence comes back";
  EXPECT_EQ(std::count(replies[0].body.begin() + 4, replies[0].body.end(), std::byte{0}), 28);
  EXPECT_EQ(joint1(), 0.0);
}

TEST_F(Rx60Velocity, TopicsAreNotAnswered) {
  makeVelocityReady();
  send(kMotion, velocityCmd(1, {0.1}, kTopic));
  run(2);
  EXPECT_TRUE(sent(kMotion).empty());
  EXPECT_GT(joint1(), 0.0);
}

TEST_F(Rx60Velocity, SecondConfigurationCostsOneTick) {
  makeVelocityReady();
  send(kMotion, velocityCmd(1, {0.1}));
  send(kMotion, velocityCfg());
  for (int i = 0; i < 3; ++i) {
    send(kMotion, velocityCmd(2, {0.1}));
  }
  run(10);
  EXPECT_TRUE(controller.velocityMode());
  EXPECT_NEAR(joint1(), 3 * 0.1 * kTick, 1e-9) << "of four commands one was taken by the reset";
}

TEST_F(Rx60Velocity, StopSequenceTakesItsTickAndIsThenDoneWith) {
  makeVelocityReady();
  send(kMotion, velocityCmd(-4, {0.5}, kRequest));
  run(2);
  EXPECT_EQ(joint1(), 0.0);
  EXPECT_EQ(sent(kMotion).front().reply, 1);
  command(0.1);
  EXPECT_GT(joint1(), 0.0);
}

TEST_F(Rx60Velocity, MotionNeedsBothSockets) {
  makeVelocityReady();
  controller.disconnect(kState);
  command(0.5);
  EXPECT_EQ(joint1(), 0.0);
  controller.connect(kState);
  run(240);
  command(0.5);
  EXPECT_EQ(joint1(), 0.0) << "nor before state flows again";
  run(10);
  command(0.5);
  EXPECT_GT(joint1(), 0.0);
}

TEST_F(Rx60Velocity, LosingTheMotionSocketStopsTheArm) {
  makeVelocityReady();
  send(kMotion, velocityCmd(1, {0.5}));
  send(kMotion, velocityCmd(2, {0.5}));
  run();
  controller.disconnect(kMotion);
  run(10);
  EXPECT_NEAR(joint1(), 0.5 * kTick, 1e-9);
}

TEST_F(Rx60Velocity, IsRefusedBeforeTheFirstStatus) {
  connectAll();
  run(260);
  send(kMotion, velocityCfg());
  run(10);
  ASSERT_EQ(countType(sent(kState), 13), 0);
  EXPECT_EQ(sent(kMotion).front().reply, 2);
  EXPECT_FALSE(controller.velocityMode());
}

TEST_F(Rx60Velocity, NothingGoesFasterThanNominal) {
  makeVelocityReady();
  command(50.0);
  EXPECT_NEAR(joint1(), 287.0 * kDegree * kTick, 1e-6);
}

TEST_F(Rx60Velocity, InfiniteCommandStands) {
  makeVelocityReady();
  command(std::numeric_limits<double>::infinity());
  EXPECT_EQ(joint1(), 0.0);
}

class Rx60Trajectory : public ::testing::Test, protected ControllerBench {
 protected:
  /// Reply code of a point sent now.
  std::int32_t replyTo(const Bytes& point) {
    send(kMotion, point);
    run();
    const std::vector<Sent> replies = sent(kMotion);
    return replies.empty() ? 0 : replies.back().reply;
  }
};

TEST_F(Rx60Trajectory, ReachesItsPointsOneAfterTheOther) {
  makeReady();
  EXPECT_EQ(replyTo(trajectoryPoint(1, {0.2, -0.1}, 0.5)), 1);
  EXPECT_EQ(replyTo(trajectoryPoint(2, {0.1, 0.1}, 1.0)), 1);
  double farthest = 0.0;
  for (int i = 0; i < 300; ++i) {
    run();
    farthest = std::max(farthest, plant.position()[0]);
  }
  EXPECT_NEAR(farthest, 0.2, 1e-6);
  EXPECT_NEAR(plant.position()[0], 0.1, 1e-6);
  EXPECT_NEAR(plant.position()[1], 0.1, 1e-6);
  EXPECT_TRUE(controller.commandedVelocity().isZero());
}

TEST_F(Rx60Trajectory, EleventhWaitingPointIsRefused) {
  makeReady();
  EXPECT_EQ(replyTo(trajectoryPoint(0, {1.0}, 0.01)), 1) << "this one is under way";
  for (int i = 1; i <= 10; ++i) {
    EXPECT_EQ(replyTo(trajectoryPoint(i, {1.0}, 0.01)), 1) << i;
  }
  EXPECT_EQ(controller.waitingPoints(), 10U);
  EXPECT_EQ(replyTo(trajectoryPoint(11, {1.0}, 0.01)), 2);
}

TEST_F(Rx60Trajectory, PointOutOfRangeOrWithoutSpeedIsRefused) {
  makeReady();
  EXPECT_EQ(replyTo(trajectoryPoint(1, {2.8})), 2) << "joint 1 ends at 160 degrees";
  EXPECT_EQ(replyTo(trajectoryPoint(2, {0.1}, 0.0)), 2);
  EXPECT_EQ(replyTo(trajectoryPoint(3, {0.1}, -0.5)), 2);
  run(100);
  EXPECT_TRUE(plant.position().isZero());
}

TEST_F(Rx60Trajectory, StopSequenceForgetsWhatWaits) {
  makeReady();
  replyTo(trajectoryPoint(1, {1.0}, 0.1));
  replyTo(trajectoryPoint(2, {-1.0}, 0.1));
  run(20);
  EXPECT_EQ(replyTo(trajectoryPoint(-4, {})), 1);
  run();
  const JointVector stopped = plant.position();
  EXPECT_GT(stopped[0], 0.0);
  run(100);
  EXPECT_EQ(plant.position(), stopped);
  EXPECT_EQ(controller.waitingPoints(), 0U);
}

TEST_F(Rx60Trajectory, LosingEitherSocketEndsTheMoveForGood) {
  for (const Rx60Socket lost : {kMotion, kState}) {
    makeReady();
    const JointVector start = plant.position();
    const double direction = lost == kMotion ? 1.0 : -1.0;
    replyTo(trajectoryPoint(1, {direction}, 0.1));
    replyTo(trajectoryPoint(2, {0.5}, 0.1));
    run(20);
    controller.disconnect(lost);
    run(2);
    const JointVector stopped = plant.position();
    EXPECT_GT(direction * (stopped[0] - start[0]), 0.01) << nameOf(lost);
    controller.connect(lost);
    run(300);
    EXPECT_EQ(plant.position(), stopped) << nameOf(lost);
  }
}

TEST_F(Rx60Trajectory, PointInVelocityModeSwitchesBackAndIsReached) {
  makeVelocityReady();
  EXPECT_EQ(replyTo(trajectoryPoint(1, {0.05}, 0.5)), 1);
  EXPECT_TRUE(controller.velocityMode());
  run(100);
  EXPECT_FALSE(controller.velocityMode());
  EXPECT_NEAR(plant.position()[0], 0.05, 1e-6);
}

TEST_F(Rx60Trajectory, RefusesOnDemandAndThenNoMore) {
  makeReady();
  controller.refuseNextPoints(2);
  EXPECT_EQ(replyTo(trajectoryPoint(1, {0.1})), 2);
  EXPECT_EQ(replyTo(trajectoryPoint(1, {0.1})), 2);
  EXPECT_EQ(replyTo(trajectoryPoint(1, {0.1})), 1);
}

}  // namespace
}  // namespace ringhook
