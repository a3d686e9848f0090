#include "sim/controller_port.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "rx60_bytes.h"
#include "sim/cell_world.h"

namespace ringhook {
namespace {

using namespace test;
using rx60::Channel;

Time at(double seconds) { return Time::fromSeconds(seconds); }

/// A client that looks at raw bytes.
class Port : public ::testing::Test {
 protected:
  Bytes readAll(Channel channel) {
    Bytes all;
    std::array<std::byte, 1000> room{};
    while (const std::optional<std::size_t> count = port.read(channel, room)) {
      if (*count == 0) {
        break;
      }
      all.insert(all.end(), room.begin(), room.begin() + static_cast<std::ptrdiff_t>(*count));
    }
    return all;
  }
  /// Waits like a link: until `end`, taking what comes. The state channel's bytes.
  Bytes listen(Time end) {
    Bytes state;
    while (port.now() < end) {
      port.wait(end);
      const Bytes news = readAll(Channel::kState);
      state.insert(state.end(), news.begin(), news.end());
      readAll(Channel::kMotion);
      readAll(Channel::kIo);
    }
    return state;
  }
  /// Answers every feedback until `end` with this velocity of joint 1 [rad/s].
  void servo(Time end, double velocity) {
    while (port.now() < end) {
      port.wait(end);
      for (const Sent& sent : split(readAll(Channel::kState))) {
        if (sent.type == 15) {
          port.write(Channel::kMotion, velocityCmd(1, {velocity}));
        }
      }
    }
  }
  void enterVelocityMode() {
    port.open();
    listen(at(1.2));
    port.write(Channel::kMotion, velocityCfg());
    listen(at(1.3));
  }

  KinematicPlant plant;
  Rx60Controller controller{plant};
  ControllerPort port{controller, plant};
};

TEST_F(Port, TimeStandsStillUnlessWaitedFor) {
  port.open();
  readAll(Channel::kState);
  EXPECT_EQ(port.now(), at(0.0));
  port.wait(at(0.5));
  EXPECT_EQ(port.now(), at(0.5)) << "nothing comes in the first second";
  port.wait(at(0.4));
  EXPECT_EQ(port.now(), at(0.5)) << "nor does it go back";
}

TEST_F(Port, FeedbackWakesEveryFourMilliseconds) {
  port.open();
  std::vector<double> wakes;
  while (wakes.size() < 10) {
    port.wait(at(3.0));
    readAll(Channel::kState);
    wakes.push_back(port.now().seconds());
  }
  for (std::size_t i = 0; i < wakes.size(); ++i) {
    EXPECT_NEAR(wakes[i], 1.004 + 0.004 * static_cast<double>(i), 1e-9);
  }
}

TEST_F(Port, UnreadBytesWakeAtOnce) {
  port.open();
  port.wait(at(2.0));
  const Time woken = port.now();
  port.wait(at(2.0));
  EXPECT_EQ(port.now(), woken);
}

TEST_F(Port, AnsweringEachFeedbackMissesNoTick) {
  enterVelocityMode();
  servo(at(1.5), 0.1);
  const std::int64_t missed = controller.counts().missed_ticks;
  servo(at(3.5), 0.1);
  EXPECT_EQ(controller.counts().missed_ticks, missed);
  servo(at(3.5), 0.0);
  EXPECT_NEAR(plant.position()[0], 0.1 * 2.2, 2e-3);
}

TEST_F(Port, ALineSlowerThanATickMissesNoneEither) {
  enterVelocityMode();
  port.toClient(Rx60Socket::kState).setFaults({.delay = 0.010});
  port.toController(Rx60Socket::kMotion).setFaults({.delay = 0.010});
  servo(at(1.5), 0.1);
  const std::int64_t missed = controller.counts().missed_ticks;
  servo(at(2.5), 0.1);
  EXPECT_EQ(controller.counts().missed_ticks, missed);
}

TEST_F(Port, JitterMissesTicksAndBecomesAStandingBacklog) {
  enterVelocityMode();
  servo(at(1.4), 0.1);
  ASSERT_EQ(controller.waitingBytes(Rx60Socket::kMotion), 0U);
  const std::int64_t missed = controller.counts().missed_ticks;
  port.toController(Rx60Socket::kMotion).setFaults({.jitter = 0.012});
  servo(at(2.4), 0.1);
  const std::int64_t late = controller.counts().missed_ticks - missed;
  EXPECT_GE(late, 2);
  port.toController(Rx60Socket::kMotion).setFaults({});
  servo(at(3.4), 0.1);
  EXPECT_EQ(controller.counts().missed_ticks - missed, late);
  EXPECT_EQ(controller.waitingBytes(Rx60Socket::kMotion), 48U * static_cast<std::size_t>(late))
      << "each missed tick left a command that delays all later ones";
}

TEST_F(Port, LostFeedbacksAreLostWhole) {
  port.open();
  port.toClient(Rx60Socket::kState).setFaults({.loss = 0.5});
  const std::vector<Sent> frames = split(listen(at(2.0)));
  EXPECT_LT(frames.size(), 180U);
  EXPECT_GT(frames.size(), 80U);
}

TEST_F(Port, SplitAndMergedStatesAreTheSameStream) {
  port.open();
  port.toClient(Rx60Socket::kState).setFaults({.split_gap = 0.0007, .merge = 0.02});
  Bytes stream = listen(at(1.5));
  port.toClient(Rx60Socket::kState).setFaults({});
  const Bytes rest = listen(at(1.6));
  stream.insert(stream.end(), rest.begin(), rest.end());
  const std::vector<Sent> frames = split(stream);
  EXPECT_EQ(
      std::count_if(frames.begin(), frames.end(), [](const Sent& sent) { return sent.type == 15; }),
      150);
}

TEST_F(Port, FrameCutBehindItsHeaderIsLostWithItsRest) {
  enterVelocityMode();
  const Bytes cfg = velocityCmd(1, {0.5});
  port.write(Channel::kMotion, std::span(cfg).first(16));
  listen(port.now() + 0.02);
  port.write(Channel::kMotion, std::span(cfg).subspan(16));
  listen(port.now() + 0.02);
  EXPECT_EQ(plant.position()[0], 0.0);
  EXPECT_EQ(controller.counts().flushes, 1) << "the rest was taken for a frame";
  port.write(Channel::kMotion, cfg);
  listen(port.now() + 0.02);
  EXPECT_GT(plant.position()[0], 0.0) << "then all is well again";
}

TEST_F(Port, StalledReadsComeAllAtOnce) {
  enterVelocityMode();
  port.toClient(Rx60Socket::kState).stall(port.now(), 0.2);
  const Time start = port.now();
  port.wait(start + 1.0);
  EXPECT_NEAR(port.now() - start, 0.2, 1e-9);
  EXPECT_GE(split(readAll(Channel::kState)).size(), 50U);
}

TEST_F(Port, HalfOpenLinesAreSilentAndNeverClose) {
  enterVelocityMode();
  for (const Rx60Socket socket : kRx60Sockets) {
    port.toClient(socket).setFaults({.half_open = true});
    port.toController(socket).setFaults({.half_open = true});
  }
  const std::int64_t received = controller.counts().received.at(rx60::MessageType::kVelocityCfg);
  EXPECT_TRUE(port.write(Channel::kMotion, velocityCfg())) << "the sender does not notice";
  const Time start = port.now();
  port.wait(start + 5.0);
  EXPECT_NEAR(port.now() - start, 5.0, 1e-9);
  std::array<std::byte, 10> room{};
  EXPECT_EQ(port.read(Channel::kState, room), 0U);
  EXPECT_EQ(controller.counts().received.at(rx60::MessageType::kVelocityCfg), received);
}

TEST_F(Port, CutConnectionWakesAndTellsOnce) {
  enterVelocityMode();
  port.onTick([this](Time now) {
    if (now == at(1.4)) {
      port.cut(Rx60Socket::kMotion);
    }
  });
  std::array<std::byte, 10> room{};
  while (port.read(Channel::kMotion, room)) {
    port.wait(at(2.0));
    readAll(Channel::kState);
    ASSERT_LT(port.now(), at(2.0));
  }
  EXPECT_EQ(port.now(), at(1.4));
  EXPECT_FALSE(port.write(Channel::kMotion, velocityCmd(1, {0.1})));
  listen(at(1.5));
  EXPECT_EQ(port.now(), at(1.5)) << "what has been told does not wake again";
}

TEST_F(Port, RefusesToOpenAsOftenAsAsked) {
  port.refuseOpening(2);
  EXPECT_THROW(port.open(), DeviceError);
  EXPECT_THROW(port.open(), DeviceError);
  port.open();
  EXPECT_EQ(port.openings(), 1);
}

TEST_F(Port, ReconnectingDuringTheFirstSecondStartsItAgain) {
  for (int i = 0; i < 5; ++i) {
    port.open();
    EXPECT_TRUE(listen(port.now() + 0.9).empty());
  }
  port.open();
  EXPECT_FALSE(listen(port.now() + 1.1).empty());
}

TEST_F(Port, ClosingStopsTheArm) {
  enterVelocityMode();
  servo(at(1.5), 0.2);
  port.close();
  const JointVector stopped = plant.position();
  port.wait(at(2.0));
  EXPECT_LE((plant.position() - stopped).cwiseAbs().maxCoeff(), 0.2 * 0.0041);
  std::array<std::byte, 10> room{};
  EXPECT_FALSE(port.read(Channel::kState, room));
}

TEST(ControllerPort, TheCellLivesOnThePortsTime) {
  CellWorld world{CellOptions()};
  CellPlant plant(world);
  Rx60Controller controller(plant);
  ControllerPort port(controller, plant, world.time());
  port.open();
  std::vector<double> seen;
  world.every(0.1, 0.05, [&](Time time) { seen.push_back(time.seconds()); });
  port.wait(at(0.5));
  EXPECT_EQ(world.time(), at(0.5));
  EXPECT_EQ(seen.size(), 5U);
  const JointVector before = world.jointReading();
  int states = 0;
  while (port.now() < at(1.6)) {
    port.wait(at(1.6));
    std::array<std::byte, 2000> room{};
    for (const Channel channel : rx60::kChannels) {
      static_cast<void>(port.read(channel, room));
    }
    ++states;
    port.write(Channel::kMotion, states == 30 ? velocityCfg() : velocityCmd(1, {0.1}));
  }
  const double moving_s = controller.counts().velocity_ticks * Rx60Controller::kTick;
  EXPECT_GT(moving_s, 0.4);
  EXPECT_NEAR(world.jointReading()[0] - before[0], 0.1 * moving_s, 0.1 * 0.0085)
      << "up to two ticks at either end";
}

TEST(ControllerPort, TheGripperIsAValveOfTheArm) {
  CellWorld world{CellOptions()};
  CellPlant plant(world);
  Rx60Controller controller(plant);
  ControllerPort port(controller, plant, world.time());
  port.open();
  const bool closed = world.gripperClosed();
  port.write(Channel::kIo, singleIo(2, 1, !closed));
  port.wait(at(0.1));
  EXPECT_EQ(world.gripperClosed(), closed) << "another valve";
  port.write(Channel::kIo, singleIo(2, 0, !closed));
  std::array<std::byte, 200> room{};
  static_cast<void>(port.read(Channel::kIo, room));
  port.wait(at(0.2));
  EXPECT_EQ(world.gripperClosed(), !closed);
}

}  // namespace
}  // namespace ringhook
