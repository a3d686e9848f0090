#include "calib/solve/chessboard.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <regex>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr double kWindowPerSquare = 0.3;
constexpr int kSmallestWindow_px = 2;
constexpr double kSmallestSquare_px = 5.0;
constexpr int kSmallestContrast = 20;  // grey values between the darkest and the brightest pixel

std::size_t at(const Chessboard& board, int row, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(board.columns) +
         static_cast<std::size_t>(column);
}

// Smallest perpendicular distance from one corner to the grid lines through its neighbours [px].
double gridSpacing(const Corners& corners, const Chessboard& board, int row, int column) {
  const Eigen::Vector2d& p = corners[at(board, row, column)];
  double spacing = std::numeric_limits<double>::max();
  for (const auto& [dr, dc] : {std::array{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}) {
    const int r = row + dr;
    const int c = column + dc;
    if (r < 0 || c < 0 || r >= board.rows || c >= board.columns) {
      continue;
    }
    const Eigen::Vector2d a = corners[at(board, r, column)] - p;
    const Eigen::Vector2d b = corners[at(board, row, c)] - p;
    const double area = std::abs(a.x() * b.y() - a.y() * b.x());
    spacing = std::min(spacing, area / std::max({a.norm(), b.norm(), 1e-9}));
  }
  return spacing;
}

double smallestSpacing(const Corners& corners, const Chessboard& board) {
  double smallest = std::numeric_limits<double>::max();
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.columns; ++c) {
      smallest = std::min(smallest, gridSpacing(corners, board, r, c));
    }
  }
  return smallest;
}

// Mean image directions of a board's columns (first) and rows (second) [px].
Eigen::Matrix2d directions(const Corners& corners, const Chessboard& board) {
  Eigen::Matrix2d d = Eigen::Matrix2d::Zero();
  for (int r = 0; r < board.rows; ++r) {
    d.col(0) += corners[at(board, r, board.columns - 1)] - corners[at(board, r, 0)];
  }
  for (int c = 0; c < board.columns; ++c) {
    d.col(1) += corners[at(board, board.rows - 1, c)] - corners[at(board, 0, c)];
  }
  d.colwise().normalize();
  return d;
}

Corners halfTurned(const Corners& corners) { return {corners.rbegin(), corners.rend()}; }

// A board with columns = rows, counted again from the corner that followed the first one.
Corners quarterTurned(const Corners& corners, const Chessboard& board) {
  Corners turned(corners.size());
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.columns; ++c) {
      turned[at(board, r, c)] = corners[at(board, c, board.columns - 1 - r)];
    }
  }
  return turned;
}

void makeRightHanded(Corners& corners, const Chessboard& board) {
  if (directions(corners, board).determinant() > 0.0) {
    return;
  }
  for (int r = 0; r < board.rows; ++r) {
    const auto first = corners.begin() + static_cast<std::ptrdiff_t>(at(board, r, 0));
    std::reverse(first, first + board.columns);
  }
}

// Mean grey value of the squares of the first one's colour, less that of the other colour.
double firstColour(const cv::Mat& image, const Corners& corners, const Chessboard& board) {
  std::array<double, 2> sum{};
  std::array<int, 2> count{};
  for (int r = 0; r + 1 < board.rows; ++r) {
    for (int c = 0; c + 1 < board.columns; ++c) {
      const Eigen::Vector2d centre =
          (corners[at(board, r, c)] + corners[at(board, r, c + 1)] + corners[at(board, r + 1, c)] +
           corners[at(board, r + 1, c + 1)]) /
          4.0;
      const auto parity = static_cast<std::size_t>((r + c) % 2);
      sum[parity] += image.at<std::uint8_t>(static_cast<int>(std::lround(centre.y())),
                                            static_cast<int>(std::lround(centre.x())));
      ++count[parity];
    }
  }
  return sum[0] / std::max(1, count[0]) - sum[1] / std::max(1, count[1]);
}

void putDarkSquareFirst(const cv::Mat& image, Corners& corners, const Chessboard& board) {
  if (!(firstColour(image, corners, board) > 0.0)) {
    return;
  }
  if ((board.columns + board.rows) % 2 == 1) {
    corners = halfTurned(corners);
  } else if (board.columns == board.rows && board.columns % 2 == 1) {
    corners = quarterTurned(corners, board);
  }
}

void refine(const cv::Mat& image, Corners& corners, const Chessboard& board) {
  const std::vector<int> windows = refinementWindows(corners, board);
  const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::vector<cv::Point2f> one{
        cv::Point2f(static_cast<float>(corners[i].x()), static_cast<float>(corners[i].y()))};
    cv::cornerSubPix(image, one, cv::Size(windows[i], windows[i]), cv::Size(-1, -1), stop);
    corners[i] = Eigen::Vector2d(one[0].x, one[0].y);
  }
}

bool detect(const cv::Mat& image, const Chessboard& board, Corners& corners) {
  std::vector<cv::Point2f> found;
  if (!cv::findChessboardCorners(image, cv::Size(board.columns, board.rows), found) ||
      found.size() != board.size()) {
    return false;
  }
  corners.clear();
  for (const cv::Point2f& p : found) {
    corners.emplace_back(p.x, p.y);
  }
  return true;
}

std::string patternOf(const Chessboard& board) {
  return std::to_string(board.columns) + "x" + std::to_string(board.rows);
}

}  // namespace

std::vector<Eigen::Vector3d> Chessboard::points() const {
  std::vector<Eigen::Vector3d> result;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      result.emplace_back(square_m * c, square_m * r, 0.0);
    }
  }
  return result;
}

Chessboard parseBoard(const std::string& text) {
  const std::string kind = text.substr(0, text.find(':'));
  if (kind != "chessboard") {
    throw InputError("--board: unknown board kind '" + kind +
                     "', known is chessboard (as in chessboard:9x6:25mm)");
  }
  static const std::regex kForm(
      R"(chessboard:(\d{1,3})x(\d{1,3}):(\d{1,9}(?:\.\d{1,9})?)(mm|cm|m))");
  std::smatch m;
  if (!std::regex_match(text, m, kForm)) {
    throw InputError("--board: '" + text +
                     "' is not chessboard:COLUMNSxROWS:SQUARE with the inner corners counted and "
                     "the square in mm, cm or m, as in chessboard:9x6:25mm");
  }
  const double unit = m[4] == "mm" ? 1e-3 : m[4] == "cm" ? 1e-2 : 1.0;
  const Chessboard board{std::stoi(m[1]), std::stoi(m[2]), std::stod(m[3]) * unit};
  if (board.columns < 3 || board.rows < 3) {
    throw InputError("--board: '" + text + "' needs at least 3x3 inner corners");
  }
  if (!(board.square_m >= 1e-4 && board.square_m <= 10.0)) {
    throw InputError("--board: '" + text + "' needs a square between 0.1 mm and 10 m");
  }
  return board;
}

std::string toString(const Chessboard& board) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "chessboard:%dx%d:%.6gmm", board.columns, board.rows,
                1e3 * board.square_m);
  return text.data();
}

std::vector<int> refinementWindows(const Corners& rough, const Chessboard& board) {
  std::vector<int> windows;
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.columns; ++c) {
      const double w = kWindowPerSquare * gridSpacing(rough, board, r, c);
      windows.push_back(std::max(kSmallestWindow_px, static_cast<int>(std::floor(w))));
    }
  }
  return windows;
}

Outcome<Corners> findChessboard(const GrayImage& image, const Chessboard& board) {
  const auto [dark, bright] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  if (image.empty() || *bright - *dark < kSmallestContrast) {
    return Refusal{"the image has no contrast"};
  }
  try {
    cv::Mat mat(image.height, image.width, CV_8UC1);
    std::copy(image.pixels.begin(), image.pixels.end(), mat.begin<std::uint8_t>());
    Corners corners;
    if (!detect(mat, board, corners)) {
      return Refusal{"no chessboard with " + patternOf(board) + " inner corners is seen whole"};
    }
    if (smallestSpacing(corners, board) < kSmallestSquare_px) {
      return Refusal{"the board's squares are smaller than 5 px"};
    }
    makeRightHanded(corners, board);
    putDarkSquareFirst(mat, corners, board);
    refine(mat, corners, board);
    return corners;
  } catch (const cv::Exception& e) {
    return Refusal{"OpenCV could not search the image (" + e.err + ")"};
  }
}

Corners orderedLike(const Corners& left, const Corners& right, const Chessboard& board) {
  if ((board.columns + board.rows) % 2 == 1) {
    return right;
  }
  std::vector<Corners> candidates{right, halfTurned(right)};
  if (board.columns == board.rows && board.columns % 2 == 0) {
    candidates.push_back(quarterTurned(right, board));
    candidates.push_back(halfTurned(candidates.back()));
  }
  const Eigen::Matrix2d wanted = directions(left, board);
  const auto agreement = [&](const Corners& c) {
    return directions(c, board).cwiseProduct(wanted).sum();
  };
  return *std::max_element(
      candidates.begin(), candidates.end(),
      [&](const Corners& a, const Corners& b) { return agreement(a) < agreement(b); });
}

}  // namespace ringhook
