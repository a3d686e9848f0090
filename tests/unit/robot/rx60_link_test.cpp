// The client's side of the dialogue, against a controller played by the test.

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

TEST(Rx60Link, IsIdleOnceFeedbackAndStatusHaveCome) {
  ScriptedController controller;
  controller.link.opened(controller.now);
  EXPECT_EQ(controller.link.state(), LinkState::kAwaitState);
  static_cast<void>(controller.feedback());
  EXPECT_EQ(controller.link.state(), LinkState::kAwaitState);
  EXPECT_FALSE(controller.link.armed());
  controller.giveStatus(ScriptedController::good());
  EXPECT_EQ(controller.link.state(), LinkState::kIdle);
  EXPECT_TRUE(controller.link.armed());
}

TEST(Rx60Link, SaysNothingBeforeATargetIsGiven) {
  ScriptedController controller;
  controller.connect();
  for (int k = 0; k < 100; ++k) {
    EXPECT_THAT(controller.feedback(), IsEmpty());
  }
}

TEST(Rx60Link, AsksForVelocityModeAndSendsZerosUntilItIsInForce) {
  ScriptedController controller;
  controller.connect();
  controller.silent = true;
  controller.link.setTarget(slow(), controller.now);
  const auto first = controller.feedback();
  ASSERT_EQ(first.size(), 1U);
  ASSERT_TRUE(std::holds_alternative<VelocityCfg>(first[0].body));
  EXPECT_EQ(first[0].comm, CommType::kRequest);
  EXPECT_EQ(std::get<VelocityCfg>(first[0].body).kind, VelocityKind::kJoint);
  EXPECT_THAT(controller.feedback(), IsEmpty()) << "not acknowledged yet";
  controller.give(Channel::kMotion, {CommType::kReply, ReplyCode::kSuccess, first[0].body});
  controller.silent = false;
  for (int k = 0; k < LinkSettings().settle_periods; ++k) {
    controller.link.setTarget(slow(), controller.now);
    const auto zeros = velocitiesIn(controller.feedback());
    ASSERT_EQ(zeros.size(), 1U);
    EXPECT_EQ(zeros[0], JointVector::Zero());
  }
  EXPECT_EQ(controller.link.state(), LinkState::kServoing);
}

TEST(Rx60Link, AnswersEachFeedbackWithExactlyOneCommand) {
  ScriptedController controller;
  controller.connectAndServe();
  for (int k = 0; k < 50; ++k) {
    controller.link.setTarget(slow(), controller.now);
    EXPECT_EQ(velocitiesIn(controller.feedback()).size(), 1U);
  }
  const auto last = velocitiesIn(controller.feedback());
  ASSERT_EQ(last.size(), 1U);
  EXPECT_LT(off(last[0], slow()), 1e-6);
}

TEST(Rx60Link, AnswersOnlyTheNewestOfSeveralFeedbacks) {
  ScriptedController controller;
  controller.connectAndServe();
  controller.link.setTarget(slow(), controller.now);
  JointFeedback late;
  late.valid_fields = 7;
  for (int k = 0; k < 4; ++k) {
    late.position = toWire(controller.position);
    controller.give(Channel::kState, {CommType::kTopic, ReplyCode::kNone, late});
  }
  EXPECT_EQ(velocitiesIn(controller.feedback()).size(), 1U);
  EXPECT_EQ(controller.link.report().drained, 4);
}

TEST(Rx60Link, TheNewestTargetWins) {
  ScriptedController controller;
  controller.connectAndServe();
  JointVector sent = JointVector::Zero();
  for (int k = 0; k < 20; ++k) {
    controller.link.setTarget(-slow(), controller.now);
    controller.link.setTarget(slow(), controller.now);
    sent = velocitiesIn(controller.feedback()).at(0);
  }
  EXPECT_LT(off(sent, slow()), 1e-6);
}

TEST(Rx60Link, HoldsATargetThenRampsItToZero) {
  LinkSettings settings;
  settings.ramp_s = 0.04;
  ScriptedController controller(settings);
  controller.connectAndServe();
  for (int k = 0; k < 10; ++k) {
    controller.link.setTarget(slow(), controller.now);
    static_cast<void>(controller.feedback());
  }
  controller.link.setTarget(slow(), controller.now);
  for (int k = 1; k <= 30; ++k) {
    const auto sent = velocitiesIn(controller.feedback());
    ASSERT_EQ(sent.size(), 1U);
    const double age = k * kPeriod;
    const double share = age <= 0.05 ? 1.0 : std::max(0.0, 1.0 - (age - 0.05) / 0.04);
    // The limiter's jerk bound rounds the corners of the ramp.
    EXPECT_LT(off(sent[0], share * slow()), 1.5e-3) << "age " << age;
  }
  EXPECT_EQ(velocitiesIn(controller.feedback()).at(0), JointVector::Zero());
}

TEST(Rx60Link, StopsAfterAQuarterOfASecondWithoutATarget) {
  ScriptedController controller;
  controller.connectAndServe();
  controller.link.setTarget(slow(), controller.now);
  int periods = 0;
  int stops = 0;
  while (stops == 0 && periods < 100) {
    stops = stopsIn(controller.feedback());
    ++periods;
  }
  EXPECT_EQ(periods, 63) << "the first feedback after 250 ms";
  static_cast<void>(controller.feedback());
  EXPECT_EQ(controller.link.state(), LinkState::kIdle);
  EXPECT_TRUE(controller.link.armed()) << "silence of vision is not a fault";
  controller.link.setTarget(slow(), controller.now);
  static_cast<void>(controller.feedback());
  EXPECT_EQ(controller.link.state(), LinkState::kConfiguring) << "and motion may go on";
}

TEST(Rx60Link, ABacklogOfCommandsIsNotFed) {
  ScriptedController controller;
  controller.connectAndServe();
  controller.silent = true;
  std::size_t sent = 0;
  for (int k = 0; k < 10; ++k) {
    sent += velocitiesIn(controller.feedback()).size();
  }
  EXPECT_EQ(sent, static_cast<std::size_t>(LinkSettings().max_unanswered));
  EXPECT_EQ(controller.link.report().left_out, 10 - LinkSettings().max_unanswered);
}

TEST(Rx60Link, TheGripperIsAnOutputOfTheController) {
  LinkSettings settings;
  settings.gripper_module = 2;
  settings.gripper_pin = 7;
  ScriptedController controller(settings);
  controller.connect();
  controller.link.setGripper(true, controller.now);
  const auto sent = controller.collect();
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(std::get<WriteSingleIo>(sent[0].body), (WriteSingleIo{2, 7, 1}));
  EXPECT_EQ(sent[0].comm, CommType::kRequest);
  controller.verdict = ReplyCode::kFailure;
  controller.link.setGripper(false, controller.now);
  static_cast<void>(controller.collect());
  EXPECT_EQ(controller.link.state(), LinkState::kFault);
  EXPECT_THAT(controller.link.report().last_fault, HasSubstr("output 7 of module 2"));
}

TEST(Rx60Link, StopSpeaksTheLanguageOfTheModeTheControllerIsIn) {
  ScriptedController idle;
  idle.connect();
  idle.link.stop(idle.now);
  EXPECT_TRUE(std::holds_alternative<JointTrajPt>(idle.collect().at(0).body));
  ScriptedController serving;
  serving.connectAndServe();
  serving.link.stop(serving.now);
  EXPECT_TRUE(std::holds_alternative<VelocityCmd>(serving.collect().at(0).body));
  EXPECT_FALSE(serving.link.armed());
  EXPECT_EQ(serving.link.state(), LinkState::kStopping);
}

TEST(Rx60Link, PointsAreSentOneAfterTheOtherAndRefusedOnesAgain) {
  ScriptedController controller;
  controller.connect();
  const JointVector goal = controller.position + JointVector::Constant(0.1);
  ASSERT_TRUE(controller.link.move({{controller.position, 0.2}, {goal, 0.3}}, controller.now));
  controller.verdict = ReplyCode::kFailure;
  EXPECT_EQ(controller.feedback().size(), 1U);
  EXPECT_THAT(controller.feedback(), IsEmpty()) << "not at once again";
  controller.verdict = ReplyCode::kSuccess;
  std::vector<Message> sent;
  for (int k = 0; k < 20; ++k) {
    for (const Message& message : controller.feedback()) {
      sent.push_back(message);
    }
  }
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(std::get<JointTrajPt>(sent[0].body).sequence, 0);
  EXPECT_EQ(std::get<JointTrajPt>(sent[1].body).joints, toWire(goal));
  EXPECT_EQ(controller.link.state(), LinkState::kMoving) << "until the arm is there";
  controller.position = goal;
  static_cast<void>(controller.feedback());
  static_cast<void>(controller.feedback());
  EXPECT_EQ(controller.link.state(), LinkState::kIdle);
}

TEST(Rx60Link, AMoveThatDoesNotMoveTheArmIsAFault) {
  ScriptedController controller;
  controller.connect();
  const JointVector goal = controller.position + JointVector::Constant(0.1);
  ASSERT_TRUE(controller.link.move({{goal, 0.2}}, controller.now));
  for (int k = 0; k < 520; ++k) {
    static_cast<void>(controller.feedback());
  }
  EXPECT_EQ(controller.link.state(), LinkState::kFault);
  EXPECT_THAT(controller.link.report().last_fault, HasSubstr("pendant"));
}

TEST(Rx60Link, PointsOutsideTheLimitsAreNeverSent) {
  ScriptedController controller;
  controller.connect();
  JointVector beyond = controller.position;
  beyond[2] = 3.0;
  const auto far = controller.link.move({{beyond, 0.2}}, controller.now);
  ASSERT_FALSE(far);
  EXPECT_THAT(far.reason(), HasSubstr("J3"));
  EXPECT_FALSE(controller.link.move({{controller.position, 0.0}}, controller.now));
  EXPECT_FALSE(controller.link.move({}, controller.now));
  EXPECT_THAT(controller.feedback(), IsEmpty());
}

TEST(Rx60Link, AReportTellsHowTheLinkIsDoing) {
  ScriptedController controller;
  controller.connectAndServe();
  for (int k = 0; k < 100; ++k) {
    controller.position[0] += 0.01 * kPeriod;
    controller.link.setTarget(slow(), controller.now);
    controller.now = controller.now + (k % 2 == 0 ? 0.0005 : -0.0005);
    static_cast<void>(controller.feedback());
  }
  const LinkReport& report = controller.link.report();
  EXPECT_NEAR(report.arm.velocity[0], 0.01, 2e-4) << "measured: float32 positions, differentiated";
  EXPECT_NEAR(report.arrivals.period_s, kPeriod, 2e-5);
  EXPECT_GT(report.arrivals.jitter_s, 1e-4);
  EXPECT_EQ(report.arrivals.missed_cycles, 0);
  EXPECT_NEAR(report.command_age_s, kPeriod, 1e-3);
  controller.pass(2 * kPeriod);
  static_cast<void>(controller.feedback());
  EXPECT_EQ(controller.link.report().arrivals.missed_cycles, 2);
}

}  // namespace
}  // namespace ringhook::rx60
