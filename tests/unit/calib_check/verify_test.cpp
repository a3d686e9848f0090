// Truth: rigs disturbed by a known amount, points projected by the disturbed rig and seen with
// seeded noise.

#include "calib/solve/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib_check/verify_scene.h"
#include "core/angle.h"
#include "core/error.h"

namespace ringhook {
namespace {

using testing::HasSubstr;

TEST(Verify, HoldsARigThatHasNotChangedForManySeeds) {
  int alarms = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    alarms +=
        verifyRig(acceptedRig(), viewsBy(acceptedRig(), 8, 0.05, seed)).state != RigState::kOk;
  }
  EXPECT_LE(alarms, 2);
}

TEST(Verify, FindsTwoHundredthsOfADegreeAboutEachAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    int found = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const Eigen::Vector3d turn = 0.02 * kDegree * Eigen::Vector3d::Unit(axis);
      const Verification v =
          verifyRig(acceptedRig(), viewsBy(movedRig(turn, {0, 0, 0}), 8, 0.05, seed));
      found += v.state == RigState::kMoved;
      // The turn is measured within its own standard deviations.
      const Eigen::Vector3d error = v.moved.rotation_rad - turn;
      for (int i = 0; i < 3; ++i) {
        EXPECT_LT(std::abs(error[i]), 4.0 * v.moved.rotation_sigma_rad[i]) << axis << seed;
      }
    }
    EXPECT_EQ(found, 10) << axis;
  }
}

TEST(Verify, MeasuresAShiftOfTheCamera) {
  const Eigen::Vector3d shift(0.0003, 0.0008, -0.0005);
  const Verification v = verifyRig(acceptedRig(), viewsBy(movedRig({0, 0, 0}, shift), 12, 0.05, 3));
  EXPECT_EQ(v.state, RigState::kMoved);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(v.moved.translation_m[i], shift[i], 4.0 * v.moved.translation_sigma_m[i]);
  }
  EXPECT_THAT(v.reasons.front(), HasSubstr("right camera"));
}

TEST(Verify, StatesSigmasThatRepeatedTrialsConfirm) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  const Verification one = verifyRig(acceptedRig(), viewsBy(acceptedRig(), 8, 0.05, 0));
  const int trials = 150;
  for (std::uint64_t seed = 0; seed < trials; ++seed) {
    const Verification v = verifyRig(acceptedRig(), viewsBy(acceptedRig(), 8, 0.05, seed));
    // The stated sigma holds the accepted rig's own doubt, which is not in these trials.
    squares += v.moved.rotation_rad
                   .cwiseQuotient(v.moved.rotation_sigma_rad / std::sqrt(1.0 + 3.0 * 8.0 / 25.0))
                   .cwiseAbs2();
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::sqrt(squares[i] / trials), 1.0, 0.2) << i;
  }
}

TEST(Verify, TellsAChangedFocalLengthFromAMovedCamera) {
  StereoRig rig = acceptedRig();
  rig.right->K.topLeftCorner<2, 2>() *= 1.003;
  const Verification v = verifyRig(acceptedRig(), viewsBy(rig, 10, 0.05, 5));
  EXPECT_EQ(v.state, RigState::kRecalibrate);
  EXPECT_THAT(v.reasons.front(), HasSubstr("focal"));
}

TEST(Verify, TellsNoiseFromAMovedCamera) {
  const Verification v = verifyRig(acceptedRig(), viewsBy(acceptedRig(), 10, 0.25, 5));
  EXPECT_EQ(v.state, RigState::kRecalibrate);
  EXPECT_THAT(v.reasons.front(), HasSubstr("scatter"));
  EXPECT_NEAR(v.corner_sigma_px, 0.25, 0.02);
}

TEST(Verify, SuspectsTheTargetsSizeWhereLengthsAloneAreWrong) {
  std::vector<SightedView> views = viewsBy(acceptedRig(), 10, 0.05, 6);
  for (SightedView& view : views) {
    for (Eigen::Vector3d& p : view.points_t) {
      p *= 1.01;
    }
  }
  const Verification v = verifyRig(acceptedRig(), views);
  EXPECT_EQ(v.state, RigState::kRecalibrate);
  EXPECT_THAT(v.reasons.front(), HasSubstr("size"));
  EXPECT_NEAR(v.bar.mean_m / v.bar.known_m, 1.0 / 1.01 - 1.0, 5e-4);
}

TEST(Verify, MeasuresABarThatIsAskedFor) {
  VerifyOptions options;
  options.bar =
      BarEnds{{boardPoints()[0], boardPoints()[1]}, {boardPoints()[7], boardPoints()[8]}, 0.21};
  const Verification v = verifyRig(acceptedRig(), viewsBy(acceptedRig(), 10, 0.05, 6), options);
  EXPECT_EQ(v.bar.count, 10);
  EXPECT_NEAR(v.bar.known_m, 0.21, 1e-12);
  EXPECT_LT(v.bar.rms_m, 0.2e-3);
  options.bar->a_t = {{9.0, 9.0, 9.0}};
  EXPECT_THROW(verifyRig(acceptedRig(), viewsBy(acceptedRig(), 4, 0.05, 6), options), InputError);
}

TEST(Verify, ReadsPitchRollAndFocusInThePatternOfTheRows) {
  const auto rows = [](const StereoRig& rig) {
    return verifyRig(acceptedRig(), viewsBy(rig, 12, 0.02, 8)).rows;
  };
  const RowDrift pitch = rows(movedRig({0.03 * kDegree, 0, 0}, {0, 0, 0}));
  EXPECT_NEAR(std::abs(pitch.offset_px), 2500.0 * 0.03 * kDegree, 0.1);
  const RowDrift roll = rows(movedRig({0, 0, 0.03 * kDegree}, {0, 0, 0}));
  EXPECT_NEAR(std::abs(roll.along_x_px), 1024.0 * 0.03 * kDegree, 0.1);
  EXPECT_LT(std::abs(roll.offset_px), 0.1);
  StereoRig zoomed = acceptedRig();
  zoomed.right->K.topLeftCorner<2, 2>() *= 1.001;
  EXPECT_NEAR(std::abs(rows(zoomed).along_y_px), 1.0, 0.15);
}

TEST(Verify, SaysWhatTheChangeCosts) {
  // A turn about y by w shifts depth by Z^2 w / B.
  const double turn = 0.03 * kDegree;
  const Verification v =
      verifyRig(acceptedRig(), viewsBy(movedRig({0, turn, 0}, {0, 0, 0}), 12, 0.02, 9));
  EXPECT_NEAR(v.moved.cost_m, 1.3 * 1.3 * turn / 0.4, 0.5e-3);
}

TEST(Verify, RefusesTooFewViewsAndOneCamera) {
  EXPECT_THROW(verifyRig(acceptedRig(), viewsBy(acceptedRig(), 2, 0.05, 1)), InputError);
  StereoRig one = acceptedRig();
  one.right.reset();
  EXPECT_THROW(verifyRig(one, viewsBy(acceptedRig(), 5, 0.05, 1)), InputError);
}

TEST(Verify, RefusesViewsOfAnotherTargetOrAnotherInstant) {
  std::vector<SightedView> views = viewsBy(acceptedRig(), 5, 0.05, 1);
  views[2].right_px = views[3].right_px;
  EXPECT_THROW(verifyRig(acceptedRig(), views), InputError);
}

TEST(Verify, ComparesViewsOfABoardOfWhichBothCamerasSeeParts) {
  const Board board = parseBoard("charuco:10x7:30mm:22mm");
  ASSERT_EQ(board.size(), 54U);
  StereoViews pairs;
  for (SightedView& view : viewsBy(acceptedRig(), 5, 0.05, 2)) {
    StereoView pair;
    pair.left_name = view.name;
    for (int i = 0; i < 54; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (i >= 5) {
        pair.left.ids.push_back(i);
        pair.left.pixels.push_back(view.left_px[at]);
      }
      if (i < 45) {
        pair.right.ids.push_back(i);
        pair.right.pixels.push_back(view.right_px[at]);
      }
    }
    pairs.usable.push_back(pair);
  }
  const Eigen::Vector3d offset = board.points()[0];
  ASSERT_NEAR((board.points()[8] - offset).norm(), 0.24, 1e-12);
  const Verification v = verifyRig(acceptedRig(), pairs, board);
  EXPECT_EQ(v.points, 5 * 40);
  EXPECT_EQ(v.state, RigState::kOk);
}

}  // namespace
}  // namespace ringhook
