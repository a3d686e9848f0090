// What is made of a wiggle: which delay each kind of clock lets one know, and when the result is
// called bad. And the wiggle itself, as a law.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/wizard/place_delays.h"
#include "core/error.h"
#include "seen_motion.h"

namespace ringhook {
namespace {

using test::seenMotion;
using test::SeenMotionSettings;
using ::testing::HasSubstr;

WiggleRecord recordOf(double camera_delay_s, double arm_delay_s, bool mid_exposure) {
  SeenMotionSettings settings;
  settings.camera_delay_s = camera_delay_s;
  settings.arm_delay_s = arm_delay_s;
  WiggleRecord record;
  record.motion = seenMotion(settings);
  record.frames = static_cast<int>(record.motion.plate.size());
  record.stamps_are_mid_exposure = mid_exposure;
  return record;
}

TEST(DelayReport, KnowsBothDelaysWhereCamerasStampMidExposure) {
  WiggleRecord record = recordOf(0.0, 0.0047, true);
  for (int i = 0; i < 100; ++i) {
    record.lateness_s.push_back(i % 10 == 0 ? 0.050 : 0.0093 + 1e-5 * (i % 3));  // some are late
  }
  StereoRig told;
  told.robot_delay_s = 0.001;
  const Outcome<DelayReport> report = delaysOf(record, told);
  ASSERT_TRUE(report) << report.reason();
  EXPECT_NEAR(report->robot->value_s, 0.0047, 1e-4);
  EXPECT_NEAR(report->camera->value_s, 0.0093, 2e-5);
  EXPECT_EQ(report->grade, DelayGrade::ok) << report->sentence;
  const StereoRig rig = withDelays(told, *report);
  EXPECT_EQ(rig.robot_delay_s, report->robot->value_s);
  EXPECT_EQ(rig.camera_delay_s, report->camera->value_s);
}

TEST(DelayReport, TakesTheArmsDelayAsToldWhereStampsAreArrivals) {
  StereoRig told;
  told.robot_delay_s = 0.002;
  const Outcome<DelayReport> report = delaysOf(recordOf(0.009, 0.002, false), told);
  ASSERT_TRUE(report) << report.reason();
  EXPECT_FALSE(report->robot);
  EXPECT_NEAR(report->camera->value_s, 0.009, 1e-4);
  EXPECT_EQ(withDelays(told, *report).robot_delay_s, 0.002);
}

TEST(DelayReport, ARecordingTellsTheArmsDelayAndLeavesTheCamerasAsTold) {
  StereoRig told;
  told.camera_delay_s = 0.008;
  const Outcome<DelayReport> report = delaysOf(recordOf(0.0, 0.003, true), told);
  ASSERT_TRUE(report) << report.reason();
  EXPECT_FALSE(report->camera);
  EXPECT_FALSE(report->response);
  EXPECT_EQ(withDelays(told, *report).camera_delay_s, 0.008);
}

TEST(DelayReport, CallsBadWhatCannotBe) {
  const Outcome<DelayReport> early = delaysOf(recordOf(0.006, 0.0, true), {});
  ASSERT_TRUE(early) << early.reason();
  EXPECT_EQ(early->grade, DelayGrade::bad);
  EXPECT_THAT(early->sentence, HasSubstr("another clock"));
}

TEST(DelayReport, RefusesAsTheFitDoes) {
  WiggleRecord record = recordOf(0.0, 0.003, true);
  record.motion.plate.resize(10);
  EXPECT_THAT(delaysOf(record, {}).reason(), HasSubstr("too few pictures"));
}

TEST(Wiggle, StartsAndEndsAtRestWhereTheArmStands) {
  const JointVector middle = JointVector::LinSpaced(-1.0, 1.0);
  const Wiggle wiggle(middle, {});
  for (const double t : {-1.0, 0.0, wiggle.seconds(), wiggle.seconds() + 1.0}) {
    EXPECT_LT((wiggle.at(t).position - middle).norm(), 1e-12);
    EXPECT_LT(wiggle.at(t).velocity.norm(), 1e-12);
  }
}

TEST(Wiggle, TellsTheVelocityOfItsPositionsAndStaysSmall) {
  const WiggleOptions options;
  const Wiggle wiggle(JointVector::Zero(), options);
  constexpr double kStep = 1e-5;
  for (double t = 0.01; t < wiggle.seconds(); t += 0.037) {
    const JointVector slope =
        (wiggle.at(t + kStep).position - wiggle.at(t - kStep).position) / (2.0 * kStep);
    EXPECT_LT((slope - wiggle.at(t).velocity).norm(), 1e-6);
    EXPECT_LE(wiggle.at(t).position.head<3>().cwiseAbs().maxCoeff(), options.amplitude_rad);
    EXPECT_LE(wiggle.at(t).position.cwiseAbs().maxCoeff(), 2.5 * options.amplitude_rad);
    EXPECT_LT(wiggle.at(t).velocity.cwiseAbs().maxCoeff(), 0.5);
  }
}

TEST(Wiggle, RefusesMotionsThatAreNone) {
  EXPECT_THROW(Wiggle(JointVector::Zero(), {2.0, 0.01}), InputError);
  EXPECT_THROW(Wiggle(JointVector::Zero(), {8.0, 0.0}), InputError);
  EXPECT_THROW(Wiggle(JointVector::Zero(), {8.0, 0.2}), InputError);
}

}  // namespace
}  // namespace ringhook
