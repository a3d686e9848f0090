// The life of the hook filter: start, gate, loss, restart, time stamps, long runs.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstdio>
#include <random>

#include "core/error.h"
#include "hook_truth.h"
#include "outcome_text.h"
#include "prediction/chi_square.h"
#include "prediction/hook_filter.h"

namespace ringhook {
namespace {

constexpr double kTick = 0.005;

HookFilterOptions linearOptions() {
  HookFilterOptions options;
  options.model = HookMotionModel::kPendulum;
  options.fMc1 = testCamera();
  options.pivot_o = HookTruthOptions().pivot_o;
  return options;
}

/// A truth, and fixes of it every 20 ms.
struct Scene {
  HookTruthOptions truth_options;
  std::vector<Pose> truth = simulateHook(truth_options, kTick, 1200);
  std::mt19937 random{17};

  HookFix fix(int tick) {
    return noisyFix(truth_options, testCamera(), truth[static_cast<std::size_t>(tick)],
                    tick * kTick, random);
  }
  void feed(HookFilter& filter, int first_tick, int last_tick) {
    for (int tick = first_tick; tick <= last_tick; tick += 4) {
      ASSERT_EQ(reasonOf(filter.update(fix(tick))), "taken") << tick;
    }
  }
};

double errorMm(const Outcome<HookEstimate>& estimate, const Pose& fMo) {
  return estimate ? 1e3 * (estimate->fMo.translation() - fMo.translation()).norm() : 1e9;
}

TEST(HookFilterLife, WarmsUpByFixesAndTime) {
  Scene scene;
  HookFilter filter(linearOptions());
  EXPECT_EQ(reasonOf(filter.predict(Time())), "no fix yet");
  EXPECT_FALSE(filter.state());
  scene.feed(filter, 0, 96);
  EXPECT_FALSE(filter.ready());
  scene.feed(filter, 100, 100);
  EXPECT_TRUE(filter.ready());
  ASSERT_TRUE(filter.state());
  EXPECT_TRUE(filter.state()->ready);
}

TEST(HookFilterLife, RefusesBadFixesWithAReasonAndKeepsItsState) {
  Scene scene;
  HookFilter filter(linearOptions());
  scene.feed(filter, 0, 200);
  const auto before = filter.state()->belief;
  EXPECT_EQ(reasonOf(filter.update(scene.fix(200))), "late or duplicate time stamp");
  EXPECT_EQ(reasonOf(filter.update(scene.fix(150))), "late or duplicate time stamp");
  HookFix bad = scene.fix(204);
  bad.c1Mo.translation().x() = NAN;
  EXPECT_EQ(reasonOf(filter.update(bad)), "fix not finite");
  bad = scene.fix(204);
  bad.covariance(0, 0) = -1e-6;
  EXPECT_EQ(reasonOf(filter.update(bad)), "fix covariance not positive definite");
  EXPECT_EQ(filter.state()->belief.mean, before.mean);
  EXPECT_EQ(filter.state()->belief.covariance, before.covariance);
  EXPECT_EQ(reasonOf(filter.update(scene.fix(204))), "taken");
}

TEST(HookFilterLife, AGatedFixLeavesThePrediction) {
  Scene scene;
  HookFilter filter(linearOptions());
  scene.feed(filter, 0, 300);
  const auto expected = filter.predict(Time::fromSeconds(304 * kTick));
  HookFix wrong = scene.fix(304);
  wrong.c1Mo.translation().x() += 0.01;
  EXPECT_EQ(reasonOf(filter.update(wrong)), "outside the gate");
  EXPECT_GT(filter.lastNis(), chiSquareQuantile(0.9999, 6.0));
  const auto got = filter.predict(Time::fromSeconds(304 * kTick));
  ASSERT_TRUE(expected && got);
  EXPECT_TRUE(got->fMo.isApprox(expected->fMo, 1e-12));
  EXPECT_LT(errorMm(got, scene.truth[304]), 0.6);
}

TEST(HookFilterLife, IsLostAfterRefusalsInARowAndRestarts) {
  Scene scene;
  HookFilter filter(linearOptions());
  scene.feed(filter, 0, 300);
  for (int tick = 304; tick <= 320; tick += 4) {
    EXPECT_FALSE(filter.lost());
    HookFix wrong = scene.fix(tick);
    wrong.c1Mo.translation().y() += 0.05;
    EXPECT_EQ(reasonOf(filter.update(wrong)), "outside the gate");
  }
  EXPECT_TRUE(filter.lost());
  EXPECT_FALSE(filter.ready());
  EXPECT_FALSE(filter.state());
  EXPECT_EQ(reasonOf(filter.update(scene.fix(324))), "lost");
  EXPECT_EQ(reasonOf(filter.predict(Time::fromSeconds(1.7))), "lost");
  filter.restart();
  scene.feed(filter, 328, 600);
  EXPECT_TRUE(filter.ready());
  EXPECT_LT(errorMm(filter.predict(Time::fromSeconds(600 * kTick)), scene.truth[600]), 0.6);
}

TEST(HookFilterLife, AGoodFixBetweenForgivesRefusals) {
  Scene scene;
  HookFilter filter(linearOptions());
  scene.feed(filter, 0, 300);
  for (int tick = 304; tick <= 380; tick += 4) {
    HookFix fix = scene.fix(tick);
    if (tick % 8 == 0) {
      fix.c1Mo.translation().y() += 0.05;
    }
    EXPECT_EQ(static_cast<bool>(filter.update(fix)), tick % 8 != 0);
  }
  EXPECT_FALSE(filter.lost());
}

TEST(HookFilterLife, TakesIrregularTimesAndAGapOfOneSecond) {
  Scene scene;
  HookFilter filter(linearOptions());
  std::uniform_int_distribution<int> gap(1, 11);
  int tick = 0;
  for (; tick < 600; tick += gap(scene.random)) {
    ASSERT_EQ(reasonOf(filter.update(scene.fix(tick))), "taken");
  }
  ASSERT_EQ(reasonOf(filter.update(scene.fix(tick + 200))), "taken");
  EXPECT_LT(errorMm(filter.predict(Time::fromSeconds((tick + 208) * kTick)),
                    scene.truth[static_cast<std::size_t>(tick) + 208]),
            1.0);
  EXPECT_EQ(reasonOf(filter.update(scene.fix(tick + 200 + 401))), "gap too long");
  EXPECT_TRUE(filter.lost());
}

TEST(HookFilterLife, PredictsFromACopyAlsoSlightlyBackAndNotTooFar) {
  Scene scene;
  HookFilter filter(linearOptions());
  scene.feed(filter, 0, 600);
  const auto copy = filter.state();
  ASSERT_TRUE(copy);
  filter.restart();
  EXPECT_LT(errorMm(predictHook(*copy, Time::fromSeconds(600 * kTick)), scene.truth[600]), 0.5);
  EXPECT_LT(errorMm(predictHook(*copy, Time::fromSeconds(597 * kTick)), scene.truth[597]), 0.5);
  EXPECT_EQ(reasonOf(predictHook(*copy, Time::fromSeconds(5.1))), "beyond the prediction horizon");
}

TEST(HookFilterLife, RefusesOptionsOutOfRangeByName) {
  HookFilterOptions options;
  options.pendulum_length_m = 0.0;
  EXPECT_THROW(HookFilter{options}, InputError);
  options = {};
  options.gate_probability = 1.0;
  EXPECT_THROW(HookFilter{options}, InputError);
  options = {};
  options.rest_density = -1.0;
  EXPECT_THROW(HookFilter{options}, InputError);
}

// 100 000 steps at irregular times, for both models: 33 minutes of fixes.
class LongRun : public ::testing::TestWithParam<HookMotionModel> {};

TEST_P(LongRun, CovarianceStaysSymmetricPositiveDefinite) {
  HookFilterOptions options = linearOptions();
  options.model = GetParam();
  Scene scene;
  HookFix fix = scene.fix(0);
  const HangingMeasurement measurement = hangingMeasurement(fix, options);
  HookBelief belief = startHookBelief(measurement, options);
  std::uniform_real_distribution<double> gap(1e-4, 0.04);
  for (int i = 0; i < 100000; ++i) {
    belief = advanceHookBelief(belief, gap(scene.random), options);
    belief = correctHookBelief(belief, measurement, options).belief;
    ASSERT_EQ(belief.covariance, belief.covariance.transpose());
    if (i % 1000 == 999) {
      ASSERT_EQ(belief.covariance.llt().info(), Eigen::Success) << i;
      ASSERT_TRUE(belief.mean.allFinite());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, LongRun,
                         ::testing::Values(HookMotionModel::kPendulum,
                                           HookMotionModel::kConstantAcceleration));

// Truth drawn from the filter's own law: the mean of many NIS must lie in its 95 % band.
TEST(HookFilterConsistency, NisIsInItsBandOnATruthOfItsOwnLaw) {
  HookFilterOptions options = linearOptions();
  options.length_sigma_m = 0.0;  // the truth has exactly the filter's length
  options.swing_density = 1e-4;
  options.position_floor_m = options.rotation_floor_rad = 0.0;  // fixes say all of their noise
  std::mt19937 random(23);
  std::normal_distribution<double> normal;
  Scene scene;
  HookBelief truth = startHookBelief(hangingMeasurement(scene.fix(0), options), options);
  HookBelief belief = truth;
  const Eigen::MatrixXd start = truth.covariance.llt().matrixL();
  const auto draw = [&](auto size) {
    return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(size, [&] { return normal(random); }));
  };
  truth.mean += start * draw(truth.mean.size());
  double sum = 0.0;
  constexpr int kSteps = 2000;
  for (int i = 0; i < kSteps; ++i) {
    truth.covariance.setZero();
    truth = advanceHookBelief(truth, 0.02, options);
    const Eigen::MatrixXd noise = truth.covariance.llt().matrixL();  // covariance is Q now
    truth.mean += noise * draw(truth.mean.size());
    const Pose fMo = composeHookEstimate(truth, Time(), options).fMo;
    const auto measurement = hangingMeasurement(
        noisyFix(scene.truth_options, testCamera(), fMo, 0.02 * i, random), options);
    belief = advanceHookBelief(belief, 0.02, options);
    const auto correction = correctHookBelief(belief, measurement, options);
    belief = correction.belief;
    sum += correction.nis;
  }
  std::printf("matched truth: mean NIS %.3f of 6\n", sum / kSteps);
  EXPECT_GT(sum, chiSquareQuantile(0.025, 6.0 * kSteps));
  EXPECT_LT(sum, chiSquareQuantile(0.975, 6.0 * kSteps));
}

}  // namespace
}  // namespace ringhook
