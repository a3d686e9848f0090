#include "calib/solve/stereo_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "board_scene.h"
#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

const Board kBoard{BoardKind::kChessboard, 9, 6, 0.025};
constexpr double kSigma_px = 0.05;
const StereoOptions kFive{LensTerms::kFive};
const StepHook kSilent = [](double, const std::string&) {};

std::string failureOf(const StereoViews& views) {
  try {
    (void)calibrateStereo(views, kBoard, kFive, kSilent);
  } catch (const Error& e) {
    return e.what();
  }
  return "no failure";
}

TEST(StereoCalibration, RecoversTheRigWithinItsOwnUncertainty) {
  const auto c = calibrateStereo(simulatedViews(16, kBoard, kSigma_px, 1), kBoard, kFive, kSilent);
  const StereoRig truth = knownRig();
  ASSERT_TRUE(c.uncertainty);
  EXPECT_LT(c.uncertainty->baseline_m, 1e-4);
  EXPECT_NEAR(baseline(c.rig), baseline(truth), 4.0 * c.uncertainty->baseline_m);
  for (const int i : {0, 1}) {
    EXPECT_NEAR(c.rig.left.K(i, i), truth.left.K(i, i), 4.0 * c.uncertainty->focal_px);
    EXPECT_NEAR(c.rig.right->K(i, i), truth.right->K(i, i), 4.0 * c.uncertainty->focal_px);
  }
  EXPECT_LT(logSe3(c.rig.c2Mc1.inverse() * truth.c2Mc1).tail<3>().norm(), 1e-3);
  EXPECT_EQ(c.used.size(), 16U);
}

TEST(StereoCalibration, ReportsTheInjectedNoise) {
  const StereoViews views = simulatedViews(16, kBoard, kSigma_px, 2);
  const auto c = calibrateStereo(views, kBoard, kFive, kSilent);
  const double residuals = 4.0 * 16.0 * 54.0;
  const double free = redundancy(views.usable, LensTerms::kFive);
  EXPECT_DOUBLE_EQ(free, residuals - 18 - 6 - 6 * 16);
  // A root mean square of n values has the relative deviation 1 / sqrt(2 n); five of them.
  EXPECT_NEAR(c.corner_sigma_px, kSigma_px, 5.0 * kSigma_px / std::sqrt(2.0 * free));
  EXPECT_NEAR(c.rms_px, kSigma_px * std::sqrt(2.0 * free / residuals), 0.003);
  EXPECT_NEAR(c.heldout_vertical_disparity_px, kSigma_px * std::sqrt(2.0), 0.01);
  EXPECT_EQ(c.verdict.grade, Grade::kGood) << c.verdict.sentence;
}

TEST(StereoCalibration, IsExactWithoutNoise) {
  const StereoViews views = simulatedViews(8, kBoard, 0.0, 1);
  const StereoSolution s = refineSolution(startSolution(views.usable, kBoard, LensTerms::kFive),
                                          views.usable, kBoard, LensTerms::kFive);
  EXPECT_LT(rms(viewErrors(s, views.usable, kBoard)), 1e-5);
  EXPECT_NEAR(baseline(s.rig), baseline(knownRig()), 1e-8);
}

TEST(StereoCalibration, TakesOutAndNamesTheViewWhoseImagesAreNoPair) {
  StereoViews views = simulatedViews(12, kBoard, kSigma_px, 3);
  for (Eigen::Vector2d& p : views.usable[4].right.pixels) {
    p += Eigen::Vector2d(1.0, 6.0);
  }
  const auto c = calibrateStereo(views, kBoard, kFive, kSilent);
  ASSERT_EQ(c.rejected.size(), 1U);
  EXPECT_EQ(c.rejected[0].left_name, "left4.png");
  EXPECT_THAT(c.rejected[0].reason, HasSubstr("contradicts the other views"));
  EXPECT_EQ(c.used.size(), 11U);
}

TEST(StereoCalibration, KeepsEveryViewOfHonestNoise) {
  for (const std::uint32_t seed : {5U, 6U}) {
    const auto c = calibrateStereo(simulatedViews(8, kBoard, 0.3, seed), kBoard, kFive, kSilent);
    EXPECT_TRUE(c.rejected.empty());
    EXPECT_NE(c.verdict.grade, Grade::kGood);
  }
}

TEST(StereoCalibration, RefusesFewerThanFourViews) {
  EXPECT_THAT(failureOf(simulatedViews(3, kBoard, kSigma_px, 1)),
              HasSubstr("only 3 of 3 pairs show the board"));
}

TEST(StereoCalibration, NeverCallsAFlatSetOfViewsGood) {
  const StereoViews views = simulatedViews(8, kBoard, kSigma_px, 1, 0.02);
  try {
    const auto c = calibrateStereo(views, kBoard, kFive, kSilent);
    EXPECT_NE(c.verdict.grade, Grade::kGood) << c.verdict.sentence;
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("tilted"));
  }
}

TEST(StereoCalibration, StopsWhereTheHookThrows) {
  const StepHook stop = [](double, const std::string&) { throw Interrupted("stopped"); };
  EXPECT_THROW(
      (void)calibrateStereo(simulatedViews(6, kBoard, 0.0, 1), kBoard, kFive, stop),
      Interrupted);
}

}  // namespace
}  // namespace ringhook
