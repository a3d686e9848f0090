#include "calib/solve/chessboard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "board_scene.h"
#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

std::string refusalOf(const std::string& text) {
  try {
    parseBoard(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

Eigen::Matrix3d camera() {
  return (Eigen::Matrix3d() << 600, 0, 320, 0, 600, 240, 0, 0, 1).finished();
}

// A board about 0.5 m away, turned about the optical axis and tilted.
Pose boardPose(const Chessboard& board, double roll_rad, double tilt_rad) {
  const Eigen::Vector3d middle(0.5 * board.square_m * (board.columns - 1),
                               0.5 * board.square_m * (board.rows - 1), 0.0);
  const Pose roll = makePoseThetaU({0, 0, 0}, {0, 0, roll_rad});
  const Pose tilt = makePoseThetaU({0, 0, 0}, {tilt_rad, 0.7 * tilt_rad, 0});
  const Pose turned = tilt * roll;
  Pose pose = turned;
  pose.translation() = Eigen::Vector3d(0, 0, 0.5) - turned * middle;
  return pose;
}

double largestError(const Corners& found, const Chessboard& board, const Pose& cMt) {
  double largest = 0.0;
  const std::vector<Eigen::Vector3d> points = board.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d truth = (camera() * (cMt * points[i])).hnormalized();
    largest = std::max(largest, (found[i] - truth).norm());
  }
  return largest;
}

TEST(Chessboard, ReadsItsDescriptionInEveryUnit) {
  for (const char* text :
       {"chessboard:9x6:25mm", "chessboard:9x6:2.5cm", "chessboard:9x6:0.025m"}) {
    const Chessboard board = parseBoard(text);
    EXPECT_EQ(board.columns, 9);
    EXPECT_EQ(board.rows, 6);
    EXPECT_NEAR(board.square_m, 0.025, 1e-15);
    EXPECT_EQ(toString(board), "chessboard:9x6:25mm");
  }
}

TEST(Chessboard, RefusesOtherBoardsNamingTheKnownOne) {
  EXPECT_THAT(refusalOf("charuco:9x6:25mm"), HasSubstr("known is chessboard"));
  EXPECT_THAT(refusalOf("aprilgrid"), HasSubstr("'aprilgrid'"));
}

TEST(Chessboard, RefusesADescriptionWithoutUnitOrSize) {
  for (const char* text : {"chessboard:9x6:25", "chessboard:9x6", "chessboard:9:25mm",
                           "chessboard:-9x6:25mm", "chessboard:9x6:25mm ", "chessboard:9x6:25in"}) {
    EXPECT_THAT(refusalOf(text), HasSubstr("in mm, cm or m")) << text;
  }
  EXPECT_THAT(refusalOf("chessboard:2x6:25mm"), HasSubstr("3x3"));
  EXPECT_THAT(refusalOf("chessboard:9x6:0mm"), HasSubstr("between 0.1 mm and 10 m"));
}

TEST(Chessboard, FindsCornersToAFewHundredthsOfAPixel) {
  const Chessboard board{9, 6, 0.025};
  for (const double tilt : {0.0, 0.3, 0.5}) {
    const Pose cMt = boardPose(board, 0.1, tilt);
    const auto found = findChessboard(drawBoard(board, camera(), cMt, 640, 480), board);
    ASSERT_TRUE(found);
    EXPECT_LT(largestError(*found, board, cMt), 0.08) << "tilt " << tilt;
  }
}

TEST(Chessboard, CountsFromTheSameCornerHoweverTheBoardIsTurned) {
  const Chessboard board{8, 5, 0.025};
  for (const double roll : {0.0, 1.6, 3.1, 4.7}) {
    const Pose cMt = boardPose(board, roll, 0.2);
    const auto found = findChessboard(drawBoard(board, camera(), cMt, 640, 480), board);
    ASSERT_TRUE(found) << "roll " << roll;
    // A wrong order is off by whole squares, 30 px.
    EXPECT_LT(largestError(*found, board, cMt), 1.0) << "roll " << roll;
  }
}

TEST(Chessboard, OrdersAnAmbiguousBoardInTheRightImageLikeInTheLeft) {
  const Chessboard board{7, 5, 0.025};
  const Pose cMt = boardPose(board, 0.2, 0.2);
  const auto left = findChessboard(drawBoard(board, camera(), cMt, 640, 480), board);
  ASSERT_TRUE(left);
  const Corners turned(left->rbegin(), left->rend());
  EXPECT_EQ(orderedLike(*left, turned, board), *left);
  EXPECT_EQ(orderedLike(*left, *left, board), *left);
}

TEST(Chessboard, UndoesEveryQuarterTurnOfASquareBoard) {
  const Chessboard board{4, 4, 0.03};
  Corners left;
  for (const Eigen::Vector3d& p : board.points()) {
    left.push_back(1000.0 * p.head<2>());
  }
  Corners turned = left;
  for (int quarter = 0; quarter < 4; ++quarter) {
    EXPECT_EQ(orderedLike(left, turned, board), left) << quarter;
    for (std::size_t i = 0; i < turned.size(); ++i) {
      turned[i] = Eigen::Vector2d(90.0 - turned[i].y(), turned[i].x());
    }
  }
}

TEST(Chessboard, KeepsTheRefinementWindowInsideHalfASquare) {
  const Chessboard board{9, 6, 0.025};
  Corners grid;
  for (const Eigen::Vector3d& p : board.points()) {
    grid.push_back(41.0 / board.square_m * p.head<2>());
  }
  for (const int window : refinementWindows(grid, board)) {
    EXPECT_EQ(window, 12);                           // 0.3 of 41 px
    EXPECT_LT(window * std::sqrt(2.0), 0.5 * 41.0);  // its corners stay clear of a cut rim
  }
}

TEST(Chessboard, RefusesAnImageWithoutTheBoardSayingWhy) {
  const Chessboard board{9, 6, 0.025};
  EXPECT_THAT(findChessboard(GrayImage(640, 480, 128), board).reason(), HasSubstr("no contrast"));
  const GrayImage image = drawBoard(board, camera(), boardPose(board, 0.1, 0.2), 640, 480);
  const auto other = findChessboard(image, Chessboard{10, 7, 0.025});
  ASSERT_FALSE(other);
  EXPECT_THAT(other.reason(), HasSubstr("10x7"));
}

}  // namespace
}  // namespace ringhook
