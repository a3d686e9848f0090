#include "calib/solve/chessboard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "calib/solve/board_grid.h"
#include "calib/solve/cv_image.h"

namespace ringhook {
namespace {

constexpr double kRim = 0.5;  // nearest foreign edge [squares]
constexpr double kSmallestSquare_px = 5.0;
constexpr int kLargestSearch_px = 1280;

// Mean grey value of the squares of the first one's colour, less that of the other colour.
double firstColour(const GrayImage& image, const Corners& corners, const Board& board) {
  std::array<double, 2> sum{};
  std::array<int, 2> count{};
  for (int r = 0; r + 1 < board.rows; ++r) {
    for (int c = 0; c + 1 < board.columns; ++c) {
      const Eigen::Vector2d centre =
          (corners[gridIndex(board, r, c)] + corners[gridIndex(board, r, c + 1)] +
           corners[gridIndex(board, r + 1, c)] + corners[gridIndex(board, r + 1, c + 1)]) /
          4.0;
      const auto parity = static_cast<std::size_t>((r + c) % 2);
      const auto x = std::clamp(std::lround(centre.x()), 0L, image.width - 1L);
      const auto y = std::clamp(std::lround(centre.y()), 0L, image.height - 1L);
      sum[parity] += image.row(static_cast<int>(y))[x];
      ++count[parity];
    }
  }
  return sum[0] / std::max(1, count[0]) - sum[1] / std::max(1, count[1]);
}

void putDarkSquareFirst(const GrayImage& image, Corners& corners, const Board& board) {
  if (!(firstColour(image, corners, board) > 0.0)) {
    return;
  }
  if ((board.columns + board.rows) % 2 == 1) {
    std::reverse(corners.begin(), corners.end());
  } else if (board.columns == board.rows && board.columns % 2 == 1) {
    corners = quarterTurned(corners, board);
  }
}

// The image, made small enough to search in live pictures.
cv::Mat forSearch(const GrayImage& image) {
  const int reduction =
      (std::max(image.width, image.height) + kLargestSearch_px - 1) / kLargestSearch_px;
  cv::Mat mat = matOf(image);
  if (reduction <= 1) {
    return mat;
  }
  cv::Mat small;
  cv::resize(mat, small, cv::Size(image.width / reduction, image.height / reduction), 0.0, 0.0,
             cv::INTER_AREA);
  return small;
}

bool detect(const GrayImage& image, const Board& board, Corners& corners) {
  const cv::Mat mat = forSearch(image);
  std::vector<cv::Point2f> found;
  if (!cv::findChessboardCorners(mat, cv::Size(board.columns, board.rows), found) ||
      found.size() != board.size()) {
    return false;
  }
  const double sx = static_cast<double>(image.width) / mat.cols;
  const double sy = static_cast<double>(image.height) / mat.rows;
  corners.clear();
  for (const cv::Point2f& p : found) {
    corners.emplace_back(sx * (static_cast<double>(p.x) + 0.5) - 0.5,
                         sy * (static_cast<double>(p.y) + 0.5) - 0.5);
  }
  return true;
}

double greyAt(const GrayImage& image, const Eigen::Vector2d& p) {
  const auto x = std::clamp(std::lround(p.x()), 0L, image.width - 1L);
  const auto y = std::clamp(std::lround(p.y()), 0L, image.height - 1L);
  return image.row(static_cast<int>(y))[x];
}

// Do squares of both colours go on beyond a line of outermost corners? `last` is that line and
// `before` the next one inside.
bool goesOn(const GrayImage& image, const Corners& last, const Corners& before) {
  std::size_t crossings = 0;
  for (std::size_t i = 0; i < last.size(); ++i) {
    const Eigen::Vector2d out = 0.3 * (last[i] - before[i]);
    const Eigen::Vector2d along = 0.3 * (i == 0 ? last[1] - last[0] : last[i] - last[i - 1]);
    const Eigen::Vector2d next = 2.0 * last[i] - before[i];
    const double inner = greyAt(image, next - out - along) - greyAt(image, next - out + along);
    const double outer = greyAt(image, next + out - along) - greyAt(image, next + out + along);
    const double known =
        greyAt(image, last[i] - out - along) - greyAt(image, last[i] - out + along);
    const double needed = 0.5 * std::abs(known);
    if (inner * outer < 0.0 && std::min(std::abs(inner), std::abs(outer)) > needed) {
      ++crossings;
    }
  }
  return 4 * crossings >= 3 * last.size();
}

// OpenCV's search is content with a part of a larger board.
bool partOfLarger(const GrayImage& image, const Corners& corners, const Board& board) {
  const auto line = [&](int index, bool row) {
    Corners points;
    for (int k = 0; k < (row ? board.columns : board.rows); ++k) {
      points.push_back(corners[row ? gridIndex(board, index, k) : gridIndex(board, k, index)]);
    }
    return points;
  };
  return goesOn(image, line(0, true), line(1, true)) ||
         goesOn(image, line(board.rows - 1, true), line(board.rows - 2, true)) ||
         goesOn(image, line(0, false), line(1, false)) ||
         goesOn(image, line(board.columns - 1, false), line(board.columns - 2, false));
}

}  // namespace

std::string seenChessboard(const GrayImage& image) {
  try {
    std::vector<cv::Point2f> corners;
    cv::Mat meta;
    const int flags = cv::CALIB_CB_LARGER | cv::CALIB_CB_NORMALIZE_IMAGE;
    if (!cv::findChessboardCornersSB(forSearch(image), cv::Size(3, 3), corners, flags, meta)) {
      return "";
    }
    const auto [fewer, more] = std::minmax(meta.rows, meta.cols);
    return std::to_string(more) + "x" + std::to_string(fewer);
  } catch (const cv::Exception&) {
    return "";  // an explanation that cannot be had is no failure
  }
}

std::vector<int> refinementWindows(const Corners& rough, const Board& board) {
  std::vector<int> windows;
  for (const double spacing : gridSpacings(rough, board.columns, board.rows)) {
    windows.push_back(windowFor(spacing, windowShare(kRim)));
  }
  return windows;
}

void makeRightHanded(Corners& grid, int columns, int rows) {
  const auto width = static_cast<std::size_t>(columns);
  const Eigen::Vector2d along = grid[width - 1] - grid.front() + grid.back() -
                                grid[width * (static_cast<std::size_t>(rows) - 1)];
  const Eigen::Vector2d down = grid[width * (static_cast<std::size_t>(rows) - 1)] - grid.front() +
                               grid.back() - grid[width - 1];
  if (along.x() * down.y() - along.y() * down.x() > 0.0) {
    return;
  }
  for (auto first = grid.begin(); first != grid.end(); first += columns) {
    std::reverse(first, first + columns);
  }
}

Outcome<BoardSighting> findChessboard(const GrayImage& image, const Board& board) {
  Corners corners;
  if (!detect(image, board, corners)) {
    return Refusal{"no chessboard with " + std::to_string(board.columns) + "x" +
                   std::to_string(board.rows) + " inner corners is seen whole"};
  }
  const std::vector<double> spacings = gridSpacings(corners, board.columns, board.rows);
  if (*std::min_element(spacings.begin(), spacings.end()) < kSmallestSquare_px) {
    return Refusal{"the board's squares are smaller than 5 px"};
  }
  if (partOfLarger(image, corners, board)) {
    return Refusal{"a chessboard with more than " + std::to_string(board.columns) + "x" +
                   std::to_string(board.rows) + " inner corners is seen"};
  }
  makeRightHanded(corners, board.columns, board.rows);
  putDarkSquareFirst(image, corners, board);
  refineCorners(image, refinementWindows(corners, board), corners);
  BoardSighting sighting;
  sighting.ids.resize(corners.size());
  std::iota(sighting.ids.begin(), sighting.ids.end(), 0);
  sighting.pixels = corners;
  return sighting;
}

}  // namespace ringhook
