#include "sim/rx60_mishaps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "rx60_bytes.h"
#include "sim/controller_port.h"

namespace ringhook {
namespace {

using namespace test;
using rx60::Channel;
using ::testing::HasSubstr;

TEST(Mishap, IsReadWithAndWithoutADuration) {
  const Mishap pressed = parseMishap("e-stop@5:2.5");
  EXPECT_EQ(pressed.kind, MishapKind::kEStop);
  EXPECT_EQ(pressed.start, 5.0);
  EXPECT_EQ(pressed.duration, 2.5);
  const Mishap for_good = parseMishap("half-open@0.5");
  EXPECT_EQ(for_good.kind, MishapKind::kHalfOpen);
  EXPECT_FALSE(for_good.duration);
}

TEST(Mishap, EveryNameIsKnown) {
  for (const char* name : {"e-stop", "error", "drives-off", "delay", "jitter", "loss", "split",
                           "merge", "stall", "half-open", "refuse-points", "cut"}) {
    EXPECT_STREQ(nameOf(parseMishap(std::string(name) + "@1").kind), name);
  }
}

TEST(Mishap, NonsenseIsRefusedWithWhatWasExpected) {
  const auto complaint = [](const std::string& text) {
    try {
      parseMishap(text);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(complaint("earthquake@1"), HasSubstr("one of e-stop, error"));
  EXPECT_THAT(complaint("delay"), HasSubstr("delay@5"));
  for (const char* text : {"delay@", "delay@x", "delay@-1", "delay@1:", "delay@1:2s", "delay@1:nan",
                           "delay@inf", "delay@1:2:3"}) {
    EXPECT_THAT(complaint(text), HasSubstr("NAME@SECONDS")) << text;
    EXPECT_THAT(complaint(text), HasSubstr(text));
  }
}

/// A client in velocity mode that answers every feedback, and a script of mishaps.
class Script : public ::testing::Test {
 protected:
  void begin(const std::vector<std::string>& mishaps) {
    std::vector<Mishap> parsed;
    std::transform(mishaps.begin(), mishaps.end(), std::back_inserter(parsed), parseMishap);
    script.emplace(parsed, controller, port);
    port.onTick([this](Time now) {
      for (const std::string& event : script->tick(now)) {
        events.push_back(std::to_string(now.seconds()).substr(0, 5) + " " + event);
      }
    });
    port.open();
  }
  /// Until `end` [s]; reconnects whenever a connection is lost.
  void live(double end) {
    std::vector<std::byte> room(20000);
    while (port.now().seconds() < end) {
      port.wait(Time::fromSeconds(end));
      const std::optional<std::size_t> state = port.read(Channel::kState, room);
      const bool open = state && port.read(Channel::kMotion, room) && port.read(Channel::kIo, room);
      if (!open) {
        port.open();
        continue;
      }
      deliveries.push_back(*state);
      if (*state > 0) {
        const bool ready = port.now().seconds() > 1.2;
        const bool first = ready && !controller.velocityMode() && !controller.switchingMode();
        port.write(Channel::kMotion, first ? velocityCfg() : velocityCmd(1, {ready ? 0.1 : 0.0}));
      }
    }
  }
  [[nodiscard]] double speedFrom(double start, double end) {
    live(start);
    const double before = plant.position()[0];
    live(end);
    return (plant.position()[0] - before) / (end - start);
  }

  KinematicPlant plant;
  Rx60Controller controller{plant};
  ControllerPort port{controller, plant};
  std::optional<MishapScript> script;
  std::vector<std::string> events;
  std::vector<std::size_t> deliveries;  ///< bytes of state at each wake
};

TEST_F(Script, WithoutMishapsTheArmFollows) {
  begin({});
  EXPECT_NEAR(speedFrom(1.4, 2.0), 0.1, 1e-4);
  EXPECT_TRUE(events.empty());
}

TEST_F(Script, EStopStopsAndItsEndLetsMoveAgain) {
  begin({"e-stop@2:0.5"});
  EXPECT_EQ(speedFrom(2.01, 2.49), 0.0);
  EXPECT_TRUE(controller.status().e_stopped);
  EXPECT_NEAR(speedFrom(2.6, 3.0), 0.1, 1e-4);
  EXPECT_EQ(events, (std::vector<std::string>{"2.000 e-stop begins", "2.500 e-stop ends"}));
}

TEST_F(Script, DrivesOffAndErrorStopForTheirTime) {
  begin({"drives-off@2:0.2", "error@3:0.2"});
  EXPECT_EQ(speedFrom(2.01, 2.19), 0.0);
  EXPECT_NEAR(speedFrom(2.4, 3.0), 0.1, 1e-3);
  EXPECT_EQ(speedFrom(3.01, 3.19), 0.0);
  EXPECT_EQ(controller.status().in_error, 1);
  EXPECT_NEAR(speedFrom(3.4, 4.0), 0.1, 1e-3);
}

TEST_F(Script, DelayIsFeltAsASlowAnswer) {
  begin({"delay@2"});
  EXPECT_NEAR(speedFrom(2.0, 2.1), 0.1 * 0.6, 0.1 * 0.05) << "40 of 100 ms have no command";
  EXPECT_NEAR(speedFrom(2.2, 2.5), 0.1, 1e-4);
}

TEST_F(Script, JitterMissesTicks) {
  begin({"jitter@2:1"});
  live(2.0);
  const std::int64_t missed = controller.counts().missed_ticks;
  live(3.0);
  EXPECT_GT(controller.counts().missed_ticks, missed);
}

TEST_F(Script, LossLeavesATenthOfTheTicksUnanswered) {
  begin({"loss@2"});
  live(2.0);
  const std::int64_t missed = controller.counts().missed_ticks;
  live(6.0);
  EXPECT_NEAR(static_cast<double>(controller.counts().missed_ticks - missed), 100.0, 30.0);
}

TEST_F(Script, SplitFramesComeInPieces) {
  begin({"split@2"});
  live(2.0);
  deliveries.clear();
  live(2.1);
  EXPECT_LT(*std::min_element(deliveries.begin(), deliveries.end() - 1), 148U);
}

TEST_F(Script, MergedFramesComeTogether) {
  begin({"merge@2"});
  live(2.05);
  deliveries.clear();
  live(2.2);
  EXPECT_GE(*std::max_element(deliveries.begin(), deliveries.end()), 5 * 148U);
}

TEST_F(Script, StallEndsWithEverythingAtOnce) {
  begin({"stall@2:0.3"});
  live(2.01);
  deliveries.clear();
  live(2.35);
  EXPECT_GE(*std::max_element(deliveries.begin(), deliveries.end()), 70 * 148U);
}

TEST_F(Script, HalfOpenIsSilenceForGood) {
  begin({"half-open@2"});
  live(2.01);
  deliveries.clear();
  live(4.0);
  EXPECT_EQ(*std::max_element(deliveries.begin(), deliveries.end()), 0U);
  EXPECT_EQ(port.openings(), 1);
}

TEST_F(Script, CutHappensOnceOrMakesAStorm) {
  begin({"cut@2", "cut@4:0.5"});
  live(3.6);
  EXPECT_EQ(port.openings(), 2);
  EXPECT_NEAR(speedFrom(3.7, 3.9), 0.1, 1e-3) << "it moves again after reconnecting";
  live(4.6);
  EXPECT_GT(port.openings(), 50);
}

TEST_F(Script, RefusedPointsAreAcceptedAfterwards) {
  begin({"refuse-points@1.5:0.5"});
  const auto replyAt = [this](double time) {
    std::array<std::byte, 4000> room{};
    while (port.now().seconds() < time) {
      port.wait(Time::fromSeconds(time));
      static_cast<void>(port.read(Channel::kState, room));
    }
    port.write(Channel::kMotion, trajectoryPoint(1, {0.1}));
    std::optional<std::size_t> count = 0;
    while (count == 0U) {
      port.wait(port.now() + 1.0);
      static_cast<void>(port.read(Channel::kState, room));
      count = port.read(Channel::kMotion, room);
    }
    return split({room.begin(), room.begin() + static_cast<std::ptrdiff_t>(*count)}).back().reply;
  };
  EXPECT_EQ(replyAt(1.6), 2);
  EXPECT_EQ(replyAt(2.1), 1);
}

}  // namespace
}  // namespace ringhook
