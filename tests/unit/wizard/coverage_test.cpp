// Boards held as the wizard asks, projected by the cameras they were meant for: what is seen is
// what was asked.

#include "calib/wizard/coverage.h"

#include <gmock/gmock.h>

#include <set>

#include "rig/camera_model.h"
#include "sim/nominal_rig.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Board& board() {
  static const Board parsed = parseBoard("chessboard:9x6:30mm");
  return parsed;
}

StereoView seen(const Pose& c1Mt, const StereoRig& rig) {
  StereoView view;
  view.width = rig.left.width;
  view.height = rig.left.height;
  const auto points = board().points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p1 = c1Mt * points[i];
    view.left.ids.push_back(static_cast<int>(i));
    view.left.pixels.push_back(projectNormalised(rig.left, p1.hnormalized()));
    view.right.ids.push_back(static_cast<int>(i));
    view.right.pixels.push_back(projectNormalised(*rig.right, (rig.c2Mc1 * p1).hnormalized()));
  }
  return view;
}

Appearance shown(const Hold& hold) {
  const StereoRig rig = nominalRig();
  return appearanceOf(seen(heldPose(hold, rig, board()), rig), board(), rig.left.K(0, 0));
}

TEST(HeldBoard, IsWholeInBothPicturesWhereverItIsAsked) {
  const StereoRig rig = nominalRig();
  for (int third = 0; third < kImageThirds; ++third) {
    for (int tilt = 0; tilt < kTilts; ++tilt) {
      for (int distance = 0; distance < kDistances; ++distance) {
        const Hold hold{third, static_cast<Tilt>(tilt), static_cast<Distance>(distance)};
        const StereoView view = seen(heldPose(hold, rig, board()), rig);
        for (const auto* side : {&view.left, &view.right}) {
          for (const Eigen::Vector2d& pixel : side->pixels) {
            EXPECT_GT(pixel.minCoeff(), 0.0) << words(hold);
            EXPECT_LT(pixel.maxCoeff(), 2047.0) << words(hold);
          }
        }
      }
    }
  }
}

TEST(HeldBoard, LooksAsTiltedAsAsked) {
  for (int tilt = 0; tilt < kTilts; ++tilt) {
    for (const int third : {0, 4, 8}) {
      const Hold hold{third, static_cast<Tilt>(tilt), Distance::kMiddle};
      EXPECT_EQ(shown(hold).tilt, hold.tilt) << words(hold);
    }
  }
}

TEST(HeldBoard, TopAwayMakesTheUpperEdgeShorter) {
  const StereoRig rig = nominalRig();
  const StereoView view = seen(heldPose({4, Tilt::kTopAway, Distance::kMiddle}, rig, board()), rig);
  const double upper = (view.left.pixels[8] - view.left.pixels[0]).norm();
  const double lower = (view.left.pixels[53] - view.left.pixels[45]).norm();
  EXPECT_LT(upper, 0.95 * lower);
}

TEST(HeldBoard, IsLargerWhenNear) {
  const double near = shown({4, Tilt::kFlat, Distance::kNear}).size;
  const double far = shown({4, Tilt::kFlat, Distance::kFar}).size;
  EXPECT_NEAR(near / far, 0.85 / 0.6, 0.1);
}

TEST(BoardAppearance, SizeIsTheSideOfAnEqualSquare) {
  // n points a distance d apart vary by (n^2 - 1) d^2 / 12; here 9 x 6 of 30 mm at 0.72 of 1.35 m,
  // f = 2500 px, 2048 px wide.
  const Appearance flat = shown({4, Tilt::kFlat, Distance::kMiddle});
  const double side_m = 0.030 * std::sqrt(std::sqrt(80.0) * std::sqrt(35.0));
  EXPECT_NEAR(flat.size, side_m * 2500.0 / (0.72 * 1.35) / 2048.0, 0.01);
}

TEST(BoardCoverage, FollowingTheAdviceCoversEverything) {
  Coverage coverage;
  int pairs = 0;
  while (!coverage.lacking().empty() && pairs < 40) {
    coverage.add(shown(nextHold(coverage)));
    ++pairs;
  }
  EXPECT_THAT(coverage.lacking(), IsEmpty());
  EXPECT_LE(pairs, 24);
}

TEST(BoardCoverage, SaysWhatIsMissing) {
  Coverage coverage;
  EXPECT_THAT(coverage.lacking(), HasSubstr("12 more pairs"));
  for (int i = 0; i < 15; ++i) {
    coverage.add(shown({4, Tilt::kFlat, Distance::kMiddle}));
  }
  EXPECT_THAT(coverage.lacking(), HasSubstr("more parts of the left image"));
  for (int third = 0; third < kImageThirds; ++third) {
    coverage.add(shown({third, Tilt::kFlat, Distance::kMiddle}));
  }
  EXPECT_THAT(coverage.lacking(), HasSubstr("tilted away"));
  for (int tilt = 1; tilt < kTilts; ++tilt) {
    coverage.add(shown({4, static_cast<Tilt>(tilt), Distance::kMiddle}));
  }
  EXPECT_THAT(coverage.lacking(), HasSubstr("nearer and farther"));
}

TEST(BoardCoverage, AsksForEveryPlaceAndTiltBeforeItRepeatsOne) {
  Coverage coverage;
  std::set<int> thirds;
  std::set<Tilt> tilts;
  for (int i = 0; i < kImageThirds; ++i) {
    const Hold hold = nextHold(coverage);
    thirds.insert(hold.third);
    tilts.insert(hold.tilt);
    Appearance as_asked;
    as_asked.centre_third = hold.third;
    as_asked.tilt = hold.tilt;
    coverage.add(as_asked);
  }
  EXPECT_EQ(thirds.size(), std::size_t{kImageThirds});
  EXPECT_EQ(tilts.size(), std::size_t{kTilts});
}

}  // namespace
}  // namespace ringhook
