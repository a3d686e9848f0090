// Accuracy and consistency of the hook filter against an independent nonlinear truth.

#include "prediction/hook_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>
#include <random>

#include "hook_truth.h"
#include "prediction/chi_square.h"

namespace ringhook {
namespace {

HookFilterOptions filterOptions(HookMotionModel model) {
  HookFilterOptions options;
  options.model = model;
  options.fMc1 = testCamera();
  options.pivot_o = {0.0, -0.02, 0.45};
  return options;
}

struct RunResult {
  double rms_mm = 0.0;      ///< position error at o over the horizon
  double rms_mrad = 0.0;    ///< rotation error
  double speed_mm_s = 0.0;  ///< velocity error at o
  double nis_mean = 0.0;
  double nees_mean = 0.0;  ///< of the predicted pose, 6 degrees
  int refused = 0;
};

// Fixes at 50 Hz for `seconds`; errors of predictions over `horizon` once warm.
RunResult runFilter(const HookTruthOptions& truth_options, const HookFilterOptions& options,
                    double horizon, double seconds, unsigned seed) {
  constexpr double kTick = 0.005;
  const int ticks = static_cast<int>((seconds + 1.0) / kTick);
  const auto truth = simulateHook(truth_options, kTick, ticks);
  HookFilter filter(options);
  std::mt19937 random(seed);
  RunResult result;
  int samples = 0;
  const int ahead_ticks = static_cast<int>(std::lround(horizon / kTick));
  for (int i = 0; i * kTick < seconds; i += 4) {
    const auto update =
        filter.update(noisyFix(truth_options, options.fMc1, truth[i], i * kTick, random));
    result.refused += update ? 0 : 1;
    if (!filter.ready() || i * kTick < 1.5) {
      continue;
    }
    const auto ahead = filter.predict(Time::fromSeconds(i * kTick + horizon));
    const Pose& then = truth[i + ahead_ticks];
    const Twist d = logSe3(ahead->fMo.inverse() * then);
    const Eigen::Vector3d velocity =
        (truth[i + ahead_ticks + 1].translation() - truth[i + ahead_ticks - 1].translation()) /
        (2.0 * kTick);
    result.rms_mm += (ahead->fMo.translation() - then.translation()).squaredNorm();
    result.rms_mrad += thetaU(ahead->fMo.linear().transpose() * then.linear()).squaredNorm();
    result.speed_mm_s += (ahead->twist_f.head<3>() - velocity).squaredNorm();
    result.nis_mean += filter.lastNis();
    result.nees_mean += d.dot(ahead->covariance.llt().solve(d));
    ++samples;
  }
  result.rms_mm = 1e3 * std::sqrt(result.rms_mm / samples);
  result.rms_mrad = 1e3 * std::sqrt(result.rms_mrad / samples);
  result.speed_mm_s = 1e3 * std::sqrt(result.speed_mm_s / samples);
  result.nis_mean /= samples;
  result.nees_mean /= samples;
  return result;
}

void print(const char* what, double horizon, const RunResult& r) {
  std::printf("%-34s %3.0f ms: o %.3f mm, %.2f mrad, %.2f mm/s, NIS %.2f, NEES %.2f, refused %d\n",
              what, 1e3 * horizon, r.rms_mm, r.rms_mrad, r.speed_mm_s, r.nis_mean, r.nees_mean,
              r.refused);
}

class HookFilterAccuracy : public ::testing::Test {
 protected:
  static RunResult run(const char* what, const HookTruthOptions& truth,
                       const HookFilterOptions& options, double horizon) {
    const RunResult result = runFilter(truth, options, horizon, 15.0, 42);
    print(what, horizon, result);
    return result;
  }
};

TEST_F(HookFilterAccuracy, PendulumStaysBelowOneAndTwoMillimetres) {
  const HookTruthOptions truth;  // belt 0.05 m/s, swing 3 deg, length 2 % off, friction
  const auto options = filterOptions(HookMotionModel::kPendulum);
  EXPECT_LT(run("pendulum", truth, options, 0.04).rms_mm, 1.0);
  EXPECT_LT(run("pendulum", truth, options, 0.1).rms_mm, 2.0);
  EXPECT_LT(run("pendulum", truth, options, 0.3).rms_mm, 5.0);
}

// A hook that hangs 9 mm longer than its model: taken at the model's pivot, that point swings by
// half a millimetre, many times the noise of a good fix, and a gate would refuse the hook as a
// whole.
TEST_F(HookFilterAccuracy, PendulumLearnsHowMuchLongerAHookHangs) {
  HookTruthOptions truth;
  truth.pivot_o.z() += 0.009;
  truth.position_sigma = 5e-5;
  truth.rotation_sigma = 2e-4;
  const auto options = filterOptions(HookMotionModel::kPendulum);
  for (const double horizon : {0.04, 0.1}) {
    const RunResult result = run("9 mm longer", truth, options, horizon);
    EXPECT_EQ(result.refused, 0);
    EXPECT_LT(result.rms_mm, 0.2);
  }
}

TEST_F(HookFilterAccuracy, PendulumBeatsConstantAcceleration) {
  const HookTruthOptions truth;
  const auto pendulum = filterOptions(HookMotionModel::kPendulum);
  const auto plain = filterOptions(HookMotionModel::kConstantAcceleration);
  for (const double horizon : {0.04, 0.1, 0.3}) {
    const double with = run("pendulum", truth, pendulum, horizon).rms_mm;
    const double without = run("constant acceleration", truth, plain, horizon).rms_mm;
    EXPECT_LT(2.0 * with, without);
  }
}

// What limits it: noise of the fixes most, then the length, then sin(phi) = phi.
TEST_F(HookFilterAccuracy, LengthNoiseAndSwingLimitItBeltSpeedDoesNot) {
  const auto options = filterOptions(HookMotionModel::kPendulum);
  const double nominal = run("nominal", {}, options, 0.1).rms_mm;
  HookTruthOptions exact;
  exact.length = 0.35;
  EXPECT_LT(run("length exact", exact, options, 0.1).rms_mm, nominal);
  HookTruthOptions fast;
  fast.belt_speed = 0.3;
  EXPECT_NEAR(run("belt 0.3 m/s", fast, options, 0.1).rms_mm, nominal, 0.02);
  HookTruthOptions quiet;
  quiet.position_sigma = 2e-5;
  quiet.rotation_sigma = 1e-4;
  EXPECT_LT(run("ten times less noise", quiet, options, 0.1).rms_mm, 0.6 * nominal);
  HookTruthOptions large;
  large.swing = 0.26;
  EXPECT_LT(run("swing 15 deg", large, options, 0.04).rms_mm, 1.0);
  const RunResult far = run("swing 15 deg", large, options, 0.1);
  EXPECT_LT(far.rms_mm, 2.0);
  EXPECT_EQ(far.refused, 0);
}

// The truth is not the filter's law, so no chi-square band is promised: errors are serial. Twice
// too sure or twice too unsure would show.
TEST_F(HookFilterAccuracy, SaysHonestlyHowSureItIs) {
  const RunResult result = run("pendulum", {}, filterOptions(HookMotionModel::kPendulum), 0.1);
  EXPECT_GT(result.nis_mean, 5.0);
  EXPECT_LT(result.nis_mean, 7.0);
  EXPECT_GT(result.nees_mean, 3.0);
  EXPECT_LT(result.nees_mean, 9.0);
}

}  // namespace
}  // namespace ringhook
