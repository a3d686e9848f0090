#include "calib/solve/chessboard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "board_scene.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

Eigen::Matrix3d camera() {
  return (Eigen::Matrix3d() << 600, 0, 320, 0, 600, 240, 0, 0, 1).finished();
}

// A board about 0.5 m away, turned about the optical axis and tilted.
Pose boardPose(const Board& board, double roll_rad, double tilt_rad) {
  const Eigen::Vector3d middle(0.5 * board.pitch_m * (board.columns - 1),
                               0.5 * board.pitch_m * (board.rows - 1), 0.0);
  const Pose roll = makePoseThetaU({0, 0, 0}, {0, 0, roll_rad});
  const Pose tilt = makePoseThetaU({0, 0, 0}, {tilt_rad, 0.7 * tilt_rad, 0});
  const Pose turned = tilt * roll;
  Pose pose = turned;
  pose.translation() = Eigen::Vector3d(0, 0, 0.5) - turned * middle;
  return pose;
}

double largestError(const BoardSighting& found, const Board& board, const Pose& cMt) {
  double largest = 0.0;
  const std::vector<Eigen::Vector3d> points = board.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d truth = (camera() * (cMt * points[i])).hnormalized();
    largest = std::max(largest, (found.pixels[i] - truth).norm());
  }
  return largest;
}

TEST(Chessboard, FindsCornersToAFewHundredthsOfAPixel) {
  const Board board{BoardKind::kChessboard, 9, 6, 0.025};
  for (const double tilt : {0.0, 0.3, 0.5}) {
    const Pose cMt = boardPose(board, 0.1, tilt);
    const auto found = findBoard(drawBoard(board, camera(), cMt, 640, 480), board);
    ASSERT_TRUE(found);
    EXPECT_LT(largestError(*found, board, cMt), 0.08) << "tilt " << tilt;
  }
}

TEST(Chessboard, CountsFromTheSameCornerHoweverTheBoardIsTurned) {
  const Board board{BoardKind::kChessboard, 8, 5, 0.025};
  for (const double roll : {0.0, 1.6, 3.1, 4.7}) {
    const Pose cMt = boardPose(board, roll, 0.2);
    const auto found = findBoard(drawBoard(board, camera(), cMt, 640, 480), board);
    ASSERT_TRUE(found) << "roll " << roll;
    // A wrong order is off by whole squares, 30 px.
    EXPECT_LT(largestError(*found, board, cMt), 1.0) << "roll " << roll;
  }
}

TEST(Chessboard, OrdersAnAmbiguousBoardInTheRightImageLikeInTheLeft) {
  const Board board{BoardKind::kChessboard, 7, 5, 0.025};
  const Pose cMt = boardPose(board, 0.2, 0.2);
  const auto left = findBoard(drawBoard(board, camera(), cMt, 640, 480), board);
  ASSERT_TRUE(left);
  const BoardSighting turned{left->ids, Corners(left->pixels.rbegin(), left->pixels.rend())};
  EXPECT_EQ(orderedLike(*left, turned, board).pixels, left->pixels);
  EXPECT_EQ(orderedLike(*left, *left, board).pixels, left->pixels);
}

TEST(Chessboard, UndoesEveryQuarterTurnOfASquareBoard) {
  const Board board{BoardKind::kChessboard, 4, 4, 0.03};
  BoardSighting left;
  for (const Eigen::Vector3d& p : board.points()) {
    left.ids.push_back(static_cast<int>(left.ids.size()));
    left.pixels.emplace_back(1000.0 * p.head<2>());
  }
  BoardSighting turned = left;
  for (int quarter = 0; quarter < 4; ++quarter) {
    EXPECT_EQ(orderedLike(left, turned, board).pixels, left.pixels) << quarter;
    for (Eigen::Vector2d& p : turned.pixels) {
      p = Eigen::Vector2d(90.0 - p.y(), p.x());
    }
  }
}

TEST(Chessboard, KeepsTheRefinementWindowInsideHalfASquare) {
  const Board board{BoardKind::kChessboard, 9, 6, 0.025};
  Corners grid;
  for (const Eigen::Vector3d& p : board.points()) {
    grid.push_back(41.0 / board.pitch_m * p.head<2>());
  }
  for (const int window : refinementWindows(grid, board)) {
    EXPECT_EQ(window, 12);                           // 0.3 of 41 px
    EXPECT_LT(window * std::sqrt(2.0), 0.5 * 41.0);  // its corners stay clear of a cut rim
  }
}

TEST(Chessboard, RefusesAnImageWithoutTheBoardSayingWhy) {
  const Board board{BoardKind::kChessboard, 9, 6, 0.025};
  EXPECT_THAT(findBoard(GrayImage(640, 480, 128), board).reason(), HasSubstr("all pixels are 128"));
  const GrayImage image = drawBoard(board, camera(), boardPose(board, 0.1, 0.2), 640, 480);
  const auto other = findBoard(image, parseBoard("chessboard:10x7:25mm"));
  ASSERT_FALSE(other);
  EXPECT_THAT(other.reason(), HasSubstr("10x7"));
}

// Mean over (2 n + 1)^2 pixels.
GrayImage smeared(const GrayImage& image, int n) {
  GrayImage result = image;
  for (int y = n; y + n < image.height; ++y) {
    for (int x = n; x + n < image.width; ++x) {
      int sum = 0;
      for (int dy = -n; dy <= n; ++dy) {
        for (int dx = -n; dx <= n; ++dx) {
          sum += image.row(y + dy)[x + dx];
        }
      }
      result.row(y)[x] = static_cast<std::uint8_t>(sum / ((2 * n + 1) * (2 * n + 1)));
    }
  }
  return result;
}

TEST(Chessboard, RefusesAPartOfALargerBoard) {
  const Board printed = parseBoard("chessboard:9x6:25mm");
  const GrayImage image = drawBoard(printed, camera(), boardPose(printed, 0.1, 0.2), 640, 480);
  for (const char* said : {"chessboard:8x6:25mm", "chessboard:9x5:25mm"}) {
    const auto found = findBoard(image, parseBoard(said));
    EXPECT_FALSE(found) << said;
  }
}

TEST(Chessboard, SaysThatAPictureIsBlurredOrDark) {
  const Board board = parseBoard("chessboard:9x6:25mm");
  const GrayImage sharp = drawBoard(board, camera(), boardPose(board, 0.1, 0.2), 640, 480);
  const auto blurred = findBoard(smeared(sharp, 10), board);
  ASSERT_FALSE(blurred);
  EXPECT_THAT(blurred.reason(), HasSubstr("blurred"));
  GrayImage dark = sharp;
  GrayImage white = sharp;
  for (std::size_t i = 0; i < dark.pixels.size(); ++i) {
    dark.pixels[i] = static_cast<std::uint8_t>(dark.pixels[i] / 40);
    white.pixels[i] = static_cast<std::uint8_t>(std::min(255, 5 * dark.pixels[i] + 245));
  }
  const auto in_dark = findBoard(dark, board);
  ASSERT_FALSE(in_dark);
  EXPECT_THAT(in_dark.reason(), HasSubstr("too dark"));
  const auto in_white = findBoard(white, board);
  ASSERT_FALSE(in_white);
  EXPECT_THAT(in_white.reason(), HasSubstr("overexposed"));
}

}  // namespace
}  // namespace ringhook
