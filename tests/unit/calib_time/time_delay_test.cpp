// Delays from analytic motions with known clocks: right within a fraction of the 0.3 ms that are
// asked for, honest about how sure that is, and refused when nothing can be known.

#include "calib/solve/time_delay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <random>

#include "seen_motion.h"

namespace ringhook {
namespace {

using test::seenMotion;
using test::SeenMotionSettings;
using ::testing::HasSubstr;

TEST(TimeOffset, IsFoundWithinATenthOfAMillisecondForAnyTwoDelays) {
  const double cases[][2] = {{0.0, 0.0}, {0.004, 0.0}, {0.0, 0.008}, {0.0113, 0.0021}, {0.03, 0.0}};
  for (const auto& delays : cases) {
    SeenMotionSettings settings;
    settings.arm_delay_s = delays[0];
    settings.camera_delay_s = delays[1];
    const Outcome<TimeOffset> found = findTimeOffset(seenMotion(settings));
    ASSERT_TRUE(found) << found.reason();
    EXPECT_NEAR(found->offset_s, delays[0] - delays[1], 1e-4);
    EXPECT_LT(found->sigma_s, 1e-4);
    EXPECT_NEAR(found->rms_px, 0.06, 0.01);
  }
}

TEST(TimeOffset, IsNotBiasedByAWrongCameraPose) {
  SeenMotionSettings settings;
  settings.arm_delay_s = 0.005;
  settings.told_wrong_m = 0.004;
  settings.told_wrong_rad = 0.005;
  const Outcome<TimeOffset> found = findTimeOffset(seenMotion(settings));
  ASSERT_TRUE(found) << found.reason();
  EXPECT_NEAR(found->offset_s, 0.005, 1e-4);
}

TEST(TimeOffset, IsNotBiasedByWildCorners) {
  SeenMotionSettings settings;
  settings.arm_delay_s = 0.005;
  settings.wild_share = 0.05;
  const Outcome<TimeOffset> found = findTimeOffset(seenMotion(settings));
  ASSERT_TRUE(found) << found.reason();
  EXPECT_NEAR(found->offset_s, 0.005, 1e-4);
}

TEST(TimeOffset, IsAsFarOffAsItsSigmaSays) {
  double squares = 0.0;
  double worst = 0.0;
  constexpr int kRuns = 30;
  for (int seed = 1; seed <= kRuns; ++seed) {
    SeenMotionSettings settings;
    settings.arm_delay_s = 0.0037;
    settings.noise_px = 0.15;
    settings.seconds = 3.0;
    settings.told_wrong_m = 0.002;
    settings.seed = static_cast<std::uint64_t>(seed);
    const Outcome<TimeOffset> found = findTimeOffset(seenMotion(settings));
    ASSERT_TRUE(found) << found.reason();
    const double score = (found->offset_s - 0.0037) / found->sigma_s;
    squares += score * score;
    worst = std::max(worst, std::abs(found->offset_s - 0.0037));
  }
  const double spread = std::sqrt(squares / kRuns);
  std::cout << "error over sigma, rms of " << kRuns << " runs: " << spread << "; worst error "
            << 1e3 * worst << " ms\n";
  EXPECT_GT(spread, 0.4);
  EXPECT_LT(spread, 1.4);
}

TEST(TimeOffset, ExplainsThePicturesBetterThanNoOffset) {
  SeenMotionSettings settings;
  settings.arm_delay_s = 0.006;
  const Outcome<TimeOffset> found = findTimeOffset(seenMotion(settings));
  ASSERT_TRUE(found) << found.reason();
  EXPECT_GT(found->rms_without_px, 3.0 * found->rms_px);
}

TEST(TimeOffset, RefusesAStandstillAndAMotionTooSmall) {
  SeenMotionSettings settings;
  settings.amplitude_m = 0.0;
  const Outcome<TimeOffset> standing = findTimeOffset(seenMotion(settings));
  ASSERT_FALSE(standing);
  EXPECT_THAT(standing.reason(), HasSubstr("hardly moved"));
  settings.amplitude_m = 0.0003;
  EXPECT_FALSE(findTimeOffset(seenMotion(settings)));
}

TEST(TimeOffset, RefusesPicturesThatStatesDoNotExplain) {
  PlateMotion motion = seenMotion({});
  SeenMotionSettings other;
  other.amplitude_m = -0.02;
  motion.flange = seenMotion(other).flange;
  const Outcome<TimeOffset> found = findTimeOffset(motion);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.reason(), HasSubstr("do not explain"));
}

TEST(TimeOffset, RefusesTooFewPicturesAndPicturesWithoutStates) {
  SeenMotionSettings brief;
  brief.seconds = 1.0;
  EXPECT_THAT(findTimeOffset(seenMotion(brief)).reason(), HasSubstr("too few pictures"));
  PlateMotion motion = seenMotion({});
  motion.flange.resize(motion.flange.size() / 4);
  EXPECT_THAT(findTimeOffset(motion).reason(), HasSubstr("no state of the arm"));
}

TEST(MotionSpline, PassesAnalyticMotionBetweenItsPoints) {
  std::vector<StampedPoint> points;
  for (int i = 0; i < 200; ++i) {
    points.push_back({Time::fromSeconds(0.02 * i), test::flangeAt(0.02 * i, 0.02)});
  }
  const MotionSpline spline(points, 0.05);
  for (double t = 0.5; t < 3.5; t += 0.0137) {
    const Pose truth = test::flangeAt(t, 0.02);
    const Pose told = *spline.at(Time::fromSeconds(t));
    EXPECT_LT((told.translation() - truth.translation()).norm(), 2e-6);
    EXPECT_LT(thetaU(told.linear().transpose() * truth.linear()).norm(), 6e-6);
  }
  EXPECT_FALSE(spline.at(Time::fromSeconds(-0.01)));
  EXPECT_FALSE(spline.at(Time::fromSeconds(4.0)));
}

TEST(MotionSpline, TellsNothingAcrossAGap) {
  std::vector<StampedPoint> points;
  for (int i = 0; i < 40; ++i) {
    points.push_back({Time::fromSeconds(0.02 * i + (i < 20 ? 0.0 : 0.1)), Pose::Identity()});
  }
  const MotionSpline spline(points, 0.05);
  EXPECT_TRUE(spline.at(Time::fromSeconds(0.37)));
  EXPECT_FALSE(spline.at(Time::fromSeconds(0.45)));
}

/// Joints that follow their commands a delay later.
struct Followed {
  std::vector<SentVelocity> sent;
  std::vector<ArmState> states;
};

Followed followed(double delay_s, double noise_rad, double gain = 1.0) {
  constexpr double kPeriod = 0.004;
  std::mt19937_64 bits(7);
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto speed = [](int tick) {
    JointVector v;
    for (int j = 0; j < 6; ++j) {
      v[j] = 0.1 * std::sin(2.0 * std::numbers::pi * (0.5 + 0.13 * j) * kPeriod * tick + j);
    }
    return v;
  };
  Followed result;
  for (int tick = 0; tick < 1500; ++tick) {
    const Time stamp = Time::fromSeconds(kPeriod * tick);
    result.sent.push_back({stamp, speed(tick)});
    // Commands added up until `then`, by hand.
    const double then = kPeriod * tick - delay_s;
    ArmState state;
    state.time = stamp;
    state.position.setConstant(0.3);
    for (int k = 0; kPeriod * k < then; ++k) {
      state.position += gain * std::min(kPeriod, then - kPeriod * k) * speed(k);
    }
    for (int j = 0; j < 6; ++j) {
      state.position[j] += noise_rad * normal(bits);
    }
    result.states.push_back(state);
  }
  return result;
}

TEST(ResponseDelay, IsFoundWhateverTheGain) {
  for (const double delay : {0.0, 0.0053, 0.012, 0.031}) {
    const Followed run = followed(delay, 1e-5, 0.98);
    const Outcome<ResponseDelay> found = findResponseDelay(run.sent, run.states);
    ASSERT_TRUE(found) << found.reason();
    EXPECT_NEAR(found->delay_s, delay, 1e-4);
    EXPECT_LT(found->sigma_s, 1e-4);
  }
}

TEST(ResponseDelay, RefusesJointsThatDoNotFollow) {
  Followed run = followed(0.004, 0.0);
  const Followed still = followed(0.004, 0.0, 0.0);
  EXPECT_THAT(findResponseDelay(run.sent, still.states).reason(), HasSubstr("hardly moved"));
  std::reverse(run.sent.begin(), run.sent.end());
  std::vector<SentVelocity> wrong = run.sent;
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    wrong[i].stamp = run.sent[wrong.size() - 1 - i].stamp;
    wrong[i].joint_velocity = wrong[i].joint_velocity.reverse().eval();
  }
  EXPECT_THAT(findResponseDelay(wrong, run.states).reason(), HasSubstr("do not follow"));
}

}  // namespace
}  // namespace ringhook
