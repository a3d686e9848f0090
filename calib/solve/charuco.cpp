#include "calib/solve/charuco.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <set>

#include "calib/solve/corner_refinement.h"
#include "calib/solve/cv_image.h"

namespace ringhook {
namespace {

constexpr std::size_t kNearestMarkers = 4;
constexpr double kSmallestSquare_px = 10.0;

// DICT_<bits>X<bits>_<codes> and the few others, in OpenCV's order.
const std::map<std::string, std::pair<int, int>>& dictionaries() {
  static const std::map<std::string, std::pair<int, int>> known = [] {
    std::map<std::string, std::pair<int, int>> all;
    int number = cv::aruco::DICT_4X4_50;
    for (const char* bits : {"4X4", "5X5", "6X6", "7X7"}) {
      for (const int codes : {50, 100, 250, 1000}) {
        all["DICT_" + std::string(bits) + "_" + std::to_string(codes)] = {number++, codes};
      }
    }
    all["DICT_ARUCO_ORIGINAL"] = {cv::aruco::DICT_ARUCO_ORIGINAL, 1024};
    all["DICT_APRILTAG_16h5"] = {cv::aruco::DICT_APRILTAG_16h5, 30};
    all["DICT_APRILTAG_25h9"] = {cv::aruco::DICT_APRILTAG_25h9, 35};
    all["DICT_APRILTAG_36h10"] = {cv::aruco::DICT_APRILTAG_36h10, 2320};
    all["DICT_APRILTAG_36h11"] = {cv::aruco::DICT_APRILTAG_36h11, 587};
    return all;
  }();
  return known;
}

struct Marker {
  Eigen::Vector2d square;                  // column and row of its white square
  std::array<Eigen::Vector2d, 4> corners;  // upper left, upper right, lower right, lower left [px]
};

// White squares in the order of the markers' numbers.
std::vector<Eigen::Vector2d> whiteSquares(const Board& board, bool black_upper_left) {
  std::vector<Eigen::Vector2d> squares;
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.columns; ++c) {
      if (((r + c) % 2 == 1) == black_upper_left) {
        squares.emplace_back(c, r);
      }
    }
  }
  return squares;
}

// Corners of the marker in a square, in squares from the board's upper left corner.
std::array<Eigen::Vector2d, 4> cornersIn(const Board& board, const Eigen::Vector2d& square) {
  const double half = 0.5 * board.marker_m / board.pitch_m;
  const Eigen::Vector2d middle = square + Eigen::Vector2d(0.5, 0.5);
  return {middle + Eigen::Vector2d(-half, -half), middle + Eigen::Vector2d(half, -half),
          middle + Eigen::Vector2d(half, half), middle + Eigen::Vector2d(-half, half)};
}

// Plane of some markers to the image, in squares; empty where they do not determine it.
cv::Mat planeOf(const Board& board, const std::vector<const Marker*>& markers) {
  std::vector<cv::Point2d> plane;
  std::vector<cv::Point2d> pixels;
  for (const Marker* marker : markers) {
    const auto corners = cornersIn(board, marker->square);
    for (std::size_t i = 0; i < 4; ++i) {
      plane.emplace_back(corners[i].x(), corners[i].y());
      pixels.emplace_back(marker->corners[i].x(), marker->corners[i].y());
    }
  }
  return cv::findHomography(plane, pixels);
}

Eigen::Vector2d seenAt(const cv::Mat& H, const Eigen::Vector2d& p) {
  std::vector<cv::Point2d> out;
  cv::perspectiveTransform(std::vector<cv::Point2d>{{p.x(), p.y()}}, out, H);
  return {out[0].x, out[0].y};
}

double misfit(const Board& board, const std::vector<Marker>& markers) {
  std::vector<const Marker*> all;
  for (const Marker& marker : markers) {
    all.push_back(&marker);
  }
  const cv::Mat H = planeOf(board, all);
  if (H.empty()) {
    return std::numeric_limits<double>::infinity();
  }
  double sum = 0.0;
  for (const Marker& marker : markers) {
    const auto corners = cornersIn(board, marker.square);
    for (std::size_t i = 0; i < 4; ++i) {
      sum += (seenAt(H, corners[i]) - marker.corners[i]).squaredNorm();
    }
  }
  return sum / static_cast<double>(markers.size());
}

std::vector<Marker> placed(const Board& board, bool black_upper_left, const std::vector<int>& ids,
                           const std::vector<std::vector<cv::Point2f>>& corners) {
  const std::vector<Eigen::Vector2d> squares = whiteSquares(board, black_upper_left);
  std::vector<Marker> markers;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] < 0 || static_cast<std::size_t>(ids[i]) >= squares.size()) {
      continue;
    }
    Marker marker{squares[static_cast<std::size_t>(ids[i])], {}};
    for (std::size_t k = 0; k < 4; ++k) {
      marker.corners[k] = Eigen::Vector2d(corners[i][k].x, corners[i][k].y);
    }
    markers.push_back(marker);
  }
  return markers;
}

std::vector<Marker> seenMarkers(const GrayImage& image, const Board& board) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(dictionaries().at(board.family).first);
  std::vector<int> ids;
  std::vector<std::vector<cv::Point2f>> corners;
  cv::aruco::detectMarkers(matOf(image), dictionary, corners, ids);
  std::vector<Marker> newer = placed(board, true, ids, corners);
  if (board.rows % 2 == 1 || newer.empty()) {
    return newer;
  }
  std::vector<Marker> older = placed(board, false, ids, corners);
  return misfit(board, older) < misfit(board, newer) ? older : newer;
}

// Where the plane through the nearest markers puts a corner, and the spacing of the grid there.
struct RoughCorner {
  Eigen::Vector2d pixel;
  double spacing_px = 0.0;
};

RoughCorner roughCorner(const Board& board, const std::vector<Marker>& markers,
                        const Eigen::Vector2d& corner) {
  std::vector<const Marker*> nearest;
  for (const Marker& marker : markers) {
    nearest.push_back(&marker);
  }
  const auto distance = [&](const Marker* m) {
    return (m->square + Eigen::Vector2d(0.5, 0.5) - corner).squaredNorm();
  };
  std::sort(nearest.begin(), nearest.end(),
            [&](const Marker* a, const Marker* b) { return distance(a) < distance(b); });
  nearest.resize(std::min(nearest.size(), kNearestMarkers));
  const cv::Mat H = planeOf(board, nearest);
  if (H.empty()) {
    return {};
  }
  Corners grid;
  for (int i = 0; i < 9; ++i) {
    grid.push_back(seenAt(H, corner + Eigen::Vector2d(i % 3 - 1, i / 3 - 1)));
  }
  return {grid[4], gridSpacings(grid, 3, 3)[4]};
}

// Both markers that touch the corner (its number counted in squares) are seen.
bool surrounded(const std::set<std::pair<int, int>>& squares, int column, int row) {
  int count = 0;
  for (const auto& [dc, dr] : {std::pair{-1, -1}, {0, -1}, {-1, 0}, {0, 0}}) {
    count += static_cast<int>(squares.count({column + dc, row + dr}));
  }
  return count == 2;
}

}  // namespace

int charucoDictionarySize(const std::string& name) {
  const auto found = dictionaries().find(name);
  return found == dictionaries().end() ? 0 : found->second.second;
}

Outcome<BoardSighting> findCharuco(const GrayImage& image, const Board& board) {
  const std::vector<Marker> markers = seenMarkers(image, board);
  std::set<std::pair<int, int>> squares;
  for (const Marker& marker : markers) {
    squares.insert({static_cast<int>(marker.square.x()), static_cast<int>(marker.square.y())});
  }
  const double share = windowShare(0.5 * (1.0 - board.marker_m / board.pitch_m));
  BoardSighting sighting;
  std::vector<int> windows;
  for (int r = 1; r < board.rows; ++r) {
    for (int c = 1; c < board.columns; ++c) {
      if (!surrounded(squares, c, r)) {
        continue;
      }
      const RoughCorner rough = roughCorner(board, markers, Eigen::Vector2d(c, r));
      if (rough.spacing_px < kSmallestSquare_px) {
        continue;
      }
      sighting.ids.push_back((r - 1) * (board.columns - 1) + c - 1);
      sighting.pixels.push_back(rough.pixel);
      windows.push_back(windowFor(rough.spacing_px, share));
    }
  }
  if (sighting.ids.empty()) {
    return Refusal{"no part of a ChArUco board with " + board.family + " markers is seen (" +
                   std::to_string(markers.size()) + " of its markers)"};
  }
  refineCorners(image, windows, sighting.pixels);
  return sighting;
}

}  // namespace ringhook
