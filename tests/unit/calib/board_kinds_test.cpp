// Every kind of board, drawn and found again; truth is the projection that drew it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "board_scene.h"
#include "calib/solve/circle_grid.h"
#include "calib/solve/corner_refinement.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

CameraModel camera() {
  CameraModel model;
  model.width = 640;
  model.height = 480;
  model.K << 600, 0, 320, 0, 600, 240, 0, 0, 1;
  return model;
}

// The board's middle before the camera, tilted.
Pose held(const Board& board, double distance_m, double tilt_rad,
          const Eigen::Vector2d& aside_m = {0, 0}) {
  Pose cMt = makePoseThetaU({0, 0, 0}, {tilt_rad, 0.6 * tilt_rad, 0.1});
  cMt.translation() = Eigen::Vector3d(aside_m.x(), aside_m.y(), distance_m) - cMt * middleOf(board);
  return cMt;
}

GrayImage picture(const Board& board, const Pose& cMt, bool older_charuco = false) {
  return drawBoard(board, camera().K, cMt, 640, 480, older_charuco);
}

// Root mean square distance of what is seen from where it was drawn [px].
double scatter(const BoardSighting& seen, const Board& board, const Pose& cMt) {
  const std::vector<Eigen::Vector3d> points = board.points();
  const bool circles =
      board.kind == BoardKind::kCircles || board.kind == BoardKind::kAsymmetricCircles;
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.ids.size(); ++i) {
    const Eigen::Vector3d& p = points[static_cast<std::size_t>(seen.ids[i])];
    Eigen::Vector2d truth = projectNormalised(camera(), (cMt * p).hnormalized());
    if (circles) {
      truth += circleBias(camera(), cMt, p, board.marker_m);
    }
    sum += (seen.pixels[i] - truth).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(seen.ids.size()));
}

TEST(BoardKinds, FindsAWholeCharucoBoardOfEitherLayout) {
  const Board board = parseBoard("charuco:8x6:30mm:22mm");
  const Pose cMt = held(board, 0.45, 0.3);
  for (const bool older : {false, true}) {
    const auto seen = findBoard(picture(board, cMt, older), board);
    ASSERT_TRUE(seen) << seen.reason();
    EXPECT_EQ(seen->ids.size(), 35U);
    EXPECT_LT(scatter(*seen, board, cMt), 0.08) << "older " << older;
  }
}

TEST(BoardKinds, FindsTheSeenPartOfACharucoBoard) {
  const Board board = parseBoard("charuco:8x6:30mm:22mm");
  const Pose cMt = held(board, 0.4, 0.2, {0.12, 0.0});
  const auto seen = findBoard(picture(board, cMt), board);
  ASSERT_TRUE(seen) << seen.reason();
  EXPECT_LT(seen->ids.size(), 35U);
  EXPECT_GE(seen->ids.size(), 15U);
  EXPECT_LT(scatter(*seen, board, cMt), 0.08);
}

TEST(BoardKinds, FindsWholeGridsOfCirclesAtTheirCentroids) {
  for (const char* word : {"circles:7x5:30mm:14mm", "acircles:4x11:20mm:10mm"}) {
    const Board board = parseBoard(word);
    const Pose cMt = held(board, 0.45, 0.35);
    const auto seen = findBoard(picture(board, cMt), board);
    ASSERT_TRUE(seen) << word << ": " << seen.reason();
    EXPECT_EQ(seen->ids.size(), board.size());
    EXPECT_LT(scatter(*seen, board, cMt), 0.03) << word;
  }
}

TEST(BoardKinds, FindsTagsWhollyOrInPart) {
  const Board board = parseBoard("apriltags:4x3:40mm:12mm");
  for (const double aside : {0.0, 0.13}) {
    const Pose cMt = held(board, 0.42, 0.25, {aside, 0.0});
    const auto seen = findBoard(picture(board, cMt), board);
    ASSERT_TRUE(seen) << seen.reason();
    EXPECT_EQ(seen->ids.size() == board.size(), aside == 0.0);
    EXPECT_LT(scatter(*seen, board, cMt), 0.15);
  }
}

TEST(BoardKinds, NoticesTagsThatLieOtherwiseThanTheBoardSays) {
  const Board printed = parseBoard("apriltags:4x3:40mm:12mm");
  const GrayImage image = picture(printed, held(printed, 0.42, 0.2));
  const auto other = findBoard(image, parseBoard("apriltags:3x4:40mm:12mm"));
  ASSERT_FALSE(other);
  EXPECT_THAT(other.reason(), HasSubstr("does not lie where the board says"));
}

TEST(BoardKinds, KnowsTheBiasOfACirclesCentre) {
  // In closed form: the centre of the ellipse K (R, t) diag(r^2, r^2, -1) (R, t)^T K^T.
  const double radius = 0.02;
  const Pose cMt = makePoseThetaU({0.05, -0.03, 0.4}, {0.6, -0.4, 0.2});
  Eigen::Matrix3d H;
  H << cMt.linear().leftCols<2>(), cMt.translation();
  H = (camera().K * H).eval();
  const Eigen::Matrix3d dual =
      H * Eigen::Vector3d(radius * radius, radius * radius, -1.0).asDiagonal() * H.transpose();
  const Eigen::Vector2d centre = dual.col(2).head<2>() / dual(2, 2);
  const Eigen::Vector2d image = H.col(2).hnormalized();
  const Eigen::Vector2d bias = circleBias(camera(), cMt, Eigen::Vector3d::Zero(), 2.0 * radius);
  EXPECT_GT((centre - image).norm(), 0.3);
  EXPECT_LT((bias - (centre - image)).norm(), 0.01 * (centre - image).norm());
}

TEST(BoardKinds, KeepsTheWindowClearOfCharucoMarkers) {
  const double marker = 22.0 / 30.0;
  const double gap = 0.5 * (1.0 - marker);
  EXPECT_LT(windowShare(gap), gap);
  EXPECT_DOUBLE_EQ(windowShare(0.5), 0.3);
}

}  // namespace
}  // namespace ringhook
