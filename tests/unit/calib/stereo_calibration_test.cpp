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
  const double free = redundancy(views.usable, {LensTerms::kFive});
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
                                          views.usable, kBoard, {LensTerms::kFive});
  EXPECT_LT(rms(viewErrors(s, views.usable, kBoard)), 1e-5);
  EXPECT_NEAR(baseline(s.rig), baseline(knownRig()), 1e-8);
}

TEST(StereoCalibration, KnowsTheScatterOfEveryParameter) {
  // Ten sets of views with other noise each: errors over their standard deviations.
  std::vector<double> normalised;
  const StereoRig truth = knownRig();
  for (std::uint32_t seed = 100; seed < 110; ++seed) {
    const StereoViews views = simulatedViews(10, kBoard, kSigma_px, seed);
    const FitOptions fit{LensTerms::kFive};
    const StereoSolution s =
        refineSolution(startSolution(views.usable, kBoard, fit.terms), views.usable, kBoard, fit);
    const auto covariance = rigCovariance(s, views.usable, kBoard, fit);
    ASSERT_TRUE(covariance);
    const Uncertainty u = uncertaintyOf(s.rig, *covariance, kSigma_px);
    for (const int i : {0, 1}) {
      normalised.push_back((s.rig.left.K(i, i) - truth.left.K(i, i)) / u.left.focal_px[i]);
      normalised.push_back((s.rig.right->K(i, 2) - truth.right->K(i, 2)) / u.right.centre_px[i]);
    }
    for (const int i : {0, 1, 2, 3, 4}) {
      normalised.push_back((s.rig.left.distortion[i] - truth.left.distortion[i]) /
                           u.left.distortion[i]);
    }
    for (const int i : {0, 1, 2}) {
      normalised.push_back((s.rig.c2Mc1.translation()[i] - truth.c2Mc1.translation()[i]) /
                           u.translation_m[i]);
    }
    normalised.push_back((baseline(s.rig) - baseline(truth)) / u.baseline_m);
  }
  double squares = 0.0;
  for (const double z : normalised) {
    squares += z * z;
  }
  const auto n = static_cast<double>(normalised.size());
  // The errors of one set hang together; about four of its thirteen are independent.
  EXPECT_NEAR(std::sqrt(squares / n), 1.0, 0.35);
}

TEST(StereoCalibration, TellsWhatItMeansForAMeasuredPoint) {
  const StereoRig truth = knownRig();
  const auto c = calibrateStereo(simulatedViews(16, kBoard, kSigma_px, 1), kBoard, kFive, kSilent);
  ASSERT_TRUE(c.uncertainty);
  // By the baseline alone the depth would be off by 1.3 m * sigma_B / B.
  EXPECT_GT(c.uncertainty->position_m.z(), 1.3 * c.uncertainty->baseline_m / baseline(truth));
  EXPECT_LT(c.uncertainty->position_m.norm(), 0.01);
}

TEST(StereoCalibration, ChoosesTheLensThatUnseenViewsAsk) {
  const StereoViews views = simulatedViews(10, kBoard, kSigma_px, 4);
  const auto c = calibrateStereo(views, kBoard, StereoOptions{}, kSilent);
  EXPECT_EQ(c.terms, LensTerms::kFive);  // of the known rig
  ASSERT_EQ(c.lenses.size(), 3U);
  EXPECT_GT(c.lenses[0].heldout_px, 2.0 * c.lenses[1].heldout_px);
  EXPECT_TRUE(c.lenses[1].chosen);
  EXPECT_EQ(c.rig.left.distortion.size(), 5);
}

TEST(StereoCalibration, TakesTheSimplerLensWithinOneStandardError) {
  // Views differ by 1e-3 from noise; the second model gains ten times less, then ten times more.
  std::vector<double> simple;
  std::vector<double> same;
  std::vector<double> better;
  for (int i = 0; i < 12; ++i) {
    const double wobble = 1e-3 * std::sin(5.0 * i);
    simple.push_back(0.02);
    same.push_back(0.02 - 1e-4 + wobble);
    better.push_back(0.02 - 1e-2 + wobble);
  }
  EXPECT_EQ(chooseByOneStandardError({simple, same}), 0U);
  EXPECT_EQ(chooseByOneStandardError({simple, better}), 1U);
  EXPECT_EQ(chooseByOneStandardError({simple, better, better}), 1U);
  std::vector<double> hardly = simple;  // always better, but by a thousandth
  for (double& square : hardly) {
    square *= 0.998;
  }
  EXPECT_EQ(chooseByOneStandardError({simple, hardly}), 0U);
}

// The known board bent to a bowl 1 mm deep, which the calibration is told is flat.
StereoViews bentViews() { return simulatedViews(14, kBoard, kSigma_px, 8, 0.5, 1e-3); }

TEST(StereoCalibration, FindsTheShapeOfABentBoard) {
  const auto flat = calibrateStereo(bentViews(), kBoard, kFive, kSilent);
  const auto bent = calibrateStereo(bentViews(), kBoard, {LensTerms::kFive, true}, kSilent);
  EXPECT_GT(flat.rms_px, 3.0 * bent.rms_px);
  EXPECT_NEAR(bent.corner_sigma_px, kSigma_px, 0.005);
  EXPECT_LT(bent.heldout_vertical_disparity_px, 1.1 * std::sqrt(2.0) * kSigma_px);
  ASSERT_EQ(bent.board_points.size(), kBoard.size());
  // The bowl's rim against its middle; the gauge leaves a plane free, not the curvature.
  const auto z = [&](int row, int column) {
    return bent.board_points[static_cast<std::size_t>(row * 9 + column)].z();
  };
  const double sag = 0.25 * (z(0, 0) + z(0, 8) + z(5, 0) + z(5, 8)) - 0.5 * (z(2, 4) + z(3, 4));
  EXPECT_NEAR(sag, boardSag(kBoard, 1e-3), 5e-5);
  EXPECT_NEAR(baseline(bent.rig), baseline(knownRig()), 2e-4);
}

TEST(StereoCalibration, RefusesTheShapeOfABoardThatCanBeReadTwoWays) {
  const Board board = parseBoard("chessboard:8x6:25mm");
  try {
    (void)calibrateStereo(simulatedViews(6, board, 0.0, 1), board, {LensTerms::kFive, true},
                          kSilent);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("looks the same turned by half"));
  }
}

TEST(StereoCalibration, TakesPartsOfABoardThatDifferLeftAndRight) {
  StereoViews views = simulatedViews(12, kBoard, kSigma_px, 9);
  for (StereoView& view : views.usable) {
    // Left loses its first column, right its last two rows.
    BoardSighting left;
    for (std::size_t i = 0; i < view.left.ids.size(); ++i) {
      if (view.left.ids[i] % 9 != 0) {
        left.ids.push_back(view.left.ids[i]);
        left.pixels.push_back(view.left.pixels[i]);
      }
    }
    view.left = left;
    view.right.ids.resize(36);
    view.right.pixels.resize(36);
    EXPECT_EQ(rowDifferences(knownRig(), view).size(), 32U);
  }
  const auto c = calibrateStereo(views, kBoard, kFive, kSilent);
  EXPECT_NEAR(c.corner_sigma_px, kSigma_px, 0.005);
  EXPECT_NEAR(baseline(c.rig), baseline(knownRig()), 4.0 * c.uncertainty->baseline_m);
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
  EXPECT_THROW((void)calibrateStereo(simulatedViews(6, kBoard, 0.0, 1), kBoard, kFive, stop),
               Interrupted);
}

}  // namespace
}  // namespace ringhook
