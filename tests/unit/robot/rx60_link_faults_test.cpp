// What the client makes of everything that can go wrong, against a controller played by the test.

#include "robot/rx60/link.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scripted_controller.h"

namespace ringhook::rx60 {
namespace {

using test::off;
using test::ScriptedController;
using test::slow;
using test::stopsIn;
using test::velocitiesIn;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kPeriod = ScriptedController::kPeriod;

struct Obstacle {
  RobotStatus status;
  std::string words;
};

class Rx60LinkObstacle : public ::testing::TestWithParam<Obstacle> {};

TEST_P(Rx60LinkObstacle, StopsAtOnceAndMovesOnlyAfterRearm) {
  ScriptedController controller;
  controller.connectAndServe();
  controller.giveStatus(GetParam().status);
  EXPECT_EQ(stopsIn(controller.collect()), 1) << "before the next feedback";
  EXPECT_EQ(controller.link.state(), LinkState::kFault);
  EXPECT_THAT(controller.link.report().last_fault, HasSubstr(GetParam().words));
  EXPECT_FALSE(controller.link.rearm(controller.now)) << "still not possible";
  controller.giveStatus(ScriptedController::good());
  for (int k = 0; k < 20; ++k) {
    EXPECT_THAT(velocitiesIn(controller.feedback()), IsEmpty()) << "good again is not enough";
  }
  ASSERT_TRUE(controller.link.rearm(controller.now));
  for (int k = 0; k < 5; ++k) {
    EXPECT_THAT(velocitiesIn(controller.feedback()), IsEmpty()) << "never moves by itself";
  }
  EXPECT_EQ(controller.link.state(), LinkState::kIdle);
}

INSTANTIATE_TEST_SUITE_P(
    Status, Rx60LinkObstacle,
    ::testing::Values(Obstacle{{1, 1, 0, 0, 0, PendantMode::kAutomatic, 0}, "emergency stop"},
                      Obstacle{{1, 0, 40, 1, 0, PendantMode::kAutomatic, 0}, "error 40"},
                      Obstacle{{0, 0, 0, 0, 0, PendantMode::kAutomatic, 0}, "drives have no power"},
                      Obstacle{{1, 0, 0, 0, 0, PendantMode::kAutomatic, 0},
                               "no motion is possible"}));

TEST(Rx60Link, ALostConnectionIsClosedAndOpenedAgainOnlyByRearm) {
  ScriptedController controller;
  controller.connectAndServe();
  controller.link.lost("the cable is cut", controller.now);
  EXPECT_EQ(controller.link.state(), LinkState::kFault);
  EXPECT_TRUE(controller.link.wantsClose());
  EXPECT_FALSE(controller.link.wantsOpen());
  controller.link.closed();
  controller.pass(5.0);
  EXPECT_FALSE(controller.link.wantsOpen());
  ASSERT_TRUE(controller.link.rearm(controller.now));
  EXPECT_TRUE(controller.link.wantsOpen());
  controller.connect();
  EXPECT_EQ(controller.link.state(), LinkState::kIdle);
  for (int k = 0; k < 100; ++k) {
    EXPECT_THAT(controller.feedback(), IsEmpty()) << "the old target is forgotten";
  }
}

TEST(Rx60Link, SaysNothingToASilentControllerAndCallsItAFault) {
  ScriptedController controller;
  controller.connectAndServe();
  controller.link.setTarget(slow(), controller.now);
  controller.pass(0.049);
  EXPECT_EQ(controller.link.state(), LinkState::kServoing);
  EXPECT_THAT(controller.collect(), IsEmpty()) << "what is not renewed is zero after a tick";
  controller.pass(0.002);
  EXPECT_EQ(controller.link.state(), LinkState::kFault);
  EXPECT_THAT(controller.link.report().last_fault, HasSubstr("no feedback for 51 ms"));
}

TEST(Rx60Link, BeginsFromRestAfterTicksWithoutACommand) {
  ScriptedController controller;
  controller.connectAndServe();
  const JointVector fast = JointVector::Constant(0.5);
  for (int k = 0; k < 100; ++k) {
    controller.link.setTarget(fast, controller.now);
    static_cast<void>(controller.feedback());
  }
  EXPECT_LT(off(controller.link.report().sent_velocity, fast), 1e-3);
  controller.pass(0.012);
  controller.link.setTarget(fast, controller.now);
  const auto sent = velocitiesIn(controller.feedback());
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_LT(sent[0].cwiseAbs().maxCoeff(), 0.02) << "one step of the jerk limit";
}

TEST(Rx60Link, SilenceWhileStandingIsToleratedForHalfASecond) {
  ScriptedController controller;
  controller.connect();
  controller.pass(0.4);
  EXPECT_EQ(controller.link.state(), LinkState::kIdle);
  controller.pass(0.2);
  EXPECT_EQ(controller.link.state(), LinkState::kFault);
}

TEST(Rx60Link, AServerWithoutVelocityControlIsRefusedByName) {
  ScriptedController controller;
  controller.link.opened(controller.now);
  controller.give(Channel::kState, {CommType::kTopic, ReplyCode::kNone, JointPosition{}});
  EXPECT_EQ(controller.link.state(), LinkState::kFault);
  EXPECT_TRUE(controller.link.wantsClose());
  EXPECT_THAT(controller.link.report().last_fault, HasSubstr("velocity extension"));
}

TEST(Rx60Link, AControllerThatSaysNothingIsAFault) {
  ScriptedController controller;
  controller.link.opened(controller.now);
  controller.pass(2.9);
  EXPECT_EQ(controller.link.state(), LinkState::kAwaitState);
  controller.pass(0.2);
  EXPECT_EQ(controller.link.state(), LinkState::kFault);
}

TEST(Rx60Link, WhatIsNotUnderstoodClosesTheConnectionAndIsNamed) {
  ScriptedController controller;
  controller.connectAndServe();
  const std::array<std::byte, 16> ping = {std::byte{12}, {}, {}, {}, std::byte{1}, {}, {}, {},
                                          std::byte{1}};
  controller.giveBytes(Channel::kState, ping);
  EXPECT_TRUE(controller.link.wantsClose());
  EXPECT_THAT(controller.link.report().last_fault,
              HasSubstr("unknown type 1 and length 12 on the state connection"));
}

TEST(Rx60Link, AMessageOnTheWrongConnectionIsAFault) {
  for (const Channel channel : {Channel::kMotion, Channel::kIo}) {
    ScriptedController controller;
    controller.connectAndServe();
    controller.give(channel, {CommType::kTopic, ReplyCode::kNone, ScriptedController::good()});
    EXPECT_THAT(controller.link.report().last_fault, HasSubstr("STATUS"));
    EXPECT_TRUE(controller.link.wantsClose());
  }
}

TEST(Rx60Link, PositionsThatAreNotNumbersAreAFault) {
  ScriptedController controller;
  controller.connectAndServe();
  controller.position[2] = std::nan("");
  EXPECT_THAT(velocitiesIn(controller.feedback()), IsEmpty());
  EXPECT_EQ(controller.link.state(), LinkState::kFault);
}

TEST(Rx60Link, RepliesThatDoNotComeAreAFault) {
  ScriptedController controller;
  controller.connectAndServe();
  controller.silent = true;
  int periods = 0;
  while (controller.link.state() == LinkState::kServoing && periods < 200) {
    controller.link.setTarget(slow(), controller.now);
    static_cast<void>(controller.feedback());
    ++periods;
  }
  EXPECT_EQ(periods, 52) << "the reply is due 200 ms after the first command";
  EXPECT_THAT(controller.link.report().last_fault, HasSubstr("does not reply on the motion"));
}

}  // namespace
}  // namespace ringhook::rx60
