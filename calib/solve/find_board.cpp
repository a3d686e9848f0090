// One way into all finders, and what is asked of every sighting.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/calib3d.hpp>
#include <set>

#include "calib/solve/board.h"
#include "calib/solve/charuco.h"
#include "calib/solve/chessboard.h"
#include "calib/solve/circle_grid.h"
#include "calib/solve/image_health.h"
#include "calib/solve/small_statistics.h"
#include "calib/solve/tag_board.h"

namespace ringhook {
namespace {

constexpr int kSmallestImage_px = 40;
// Three sigma of an edge on either side must stay within the window that measures a corner.
constexpr double kMostBlur = 0.12;  // of the distance of neighbouring points
constexpr double kMostBlur_px = 2.0;
constexpr double kMostBlurAnywhere_px = 4.0;

Outcome<BoardSighting> search(const GrayImage& image, const Board& board) {
  switch (board.kind) {
    case BoardKind::kChessboard:
      return findChessboard(image, board);
    case BoardKind::kCharuco:
      return findCharuco(image, board);
    case BoardKind::kCircles:
    case BoardKind::kAsymmetricCircles:
      return findCircles(image, board);
    case BoardKind::kAprilTags:
      break;
  }
  return findTagBoard(image, board);
}

// A part of a board that fixes a pose: two rows and two columns, at least six points.
bool enough(const BoardSighting& sighting, const Board& board) {
  const std::vector<Eigen::Vector3d> points = board.points();
  std::set<double> x;
  std::set<double> y;
  for (const int id : sighting.ids) {
    x.insert(points[static_cast<std::size_t>(id)].x());
    y.insert(points[static_cast<std::size_t>(id)].y());
  }
  return sighting.ids.size() >= 6 && x.size() >= 2 && y.size() >= 2;
}

// Two points of the print, in t [m], between which one straight or round edge runs: beside a point.
std::pair<Eigen::Vector2d, Eigen::Vector2d> edgeBeside(const Board& board,
                                                       const Eigen::Vector2d& point) {
  const double p = board.pitch_m;
  const double gap = 0.5 * (p - board.marker_m);
  switch (board.kind) {
    case BoardKind::kChessboard:
    case BoardKind::kCharuco: {
      const double side = point.x() < 0.5 * p ? 0.5 * p : -0.5 * p;
      const double reach = board.kind == BoardKind::kCharuco ? 0.9 * gap : 0.3 * p;
      return {point + Eigen::Vector2d(side, -reach), point + Eigen::Vector2d(side, reach)};
    }
    case BoardKind::kAprilTags: {  // beside the middle of the tag's upper side
      const double column = p * std::floor(point.x() / p + 1e-6);
      const double row = p * std::floor(point.y() / p + 1e-6);
      const Eigen::Vector2d side(column + 0.5 * board.marker_m, row);
      const Eigen::Vector2d reach(0.0, std::min(2.0 * gap, board.marker_m / 8.0));
      return {side - reach, side + reach};
    }
    case BoardKind::kCircles:
    case BoardKind::kAsymmetricCircles:
      break;
  }
  const double radius = 0.5 * board.marker_m;
  return {point, point + Eigen::Vector2d(std::min(2.0 * radius, 0.5 * p), 0.0)};
}

// Median blur [px] of the board's own edges, and the pitch [px] there; zeros if none has contrast.
struct Sharpness {
  double blur_px = 0.0;
  double pitch_px = 0.0;
};

Sharpness sharpnessOf(const GrayImage& image, const Board& board, const BoardSighting& sighting) {
  const std::vector<Eigen::Vector3d> points = board.points();
  std::vector<cv::Point2d> plane;
  std::vector<cv::Point2d> pixels;
  for (std::size_t i = 0; i < sighting.ids.size(); ++i) {
    const Eigen::Vector3d& p = points[static_cast<std::size_t>(sighting.ids[i])];
    plane.emplace_back(p.x(), p.y());
    pixels.emplace_back(sighting.pixels[i].x(), sighting.pixels[i].y());
  }
  const cv::Mat H = cv::findHomography(plane, pixels);
  if (H.empty()) {
    return {};
  }
  std::vector<cv::Point2d> ends;
  for (const cv::Point2d& p : plane) {
    const auto [a, b] = edgeBeside(board, {p.x, p.y});
    ends.emplace_back(a.x(), a.y());
    ends.emplace_back(b.x(), b.y());
    ends.emplace_back(p.x + board.pitch_m, p.y);
  }
  cv::perspectiveTransform(ends, ends, H);
  std::vector<double> blurs;
  std::vector<double> pitches;
  for (std::size_t i = 0; i < plane.size(); ++i) {
    const cv::Point2d& a = ends[3 * i];
    const cv::Point2d& b = ends[3 * i + 1];
    const double blur = edgeBlur(image, {a.x, a.y}, {b.x, b.y});
    if (std::isfinite(blur)) {
      blurs.push_back(blur);
      pitches.push_back(
          std::hypot(ends[3 * i + 2].x - pixels[i].x, ends[3 * i + 2].y - pixels[i].y));
    }
  }
  if (blurs.size() < 4) {
    return {};
  }
  return {median(blurs), median(pitches)};
}

std::string blurText(double blur_px, double allowed_px) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(),
                "blurred: its edges are smeared by %.1f px, expected at most %.1f px (focus, hold "
                "still, or expose shorter)",
                blur_px, allowed_px);
  return text.data();
}

// Why the board was not seen, as far as the picture itself tells.
std::string faultOf(const GrayImage& image) {
  const std::string exposure = exposureFault(image);
  if (!exposure.empty()) {
    return exposure;
  }
  const double blur = strongestEdgesBlur(image);
  return blur > kMostBlurAnywhere_px ? blurText(blur, kMostBlurAnywhere_px) : "";
}

}  // namespace

Outcome<BoardSighting> findBoard(const GrayImage& image, const Board& board) {
  if (image.width < kSmallestImage_px || image.height < kSmallestImage_px) {
    return Refusal{"the image is too small to show a board"};
  }
  try {
    Outcome<BoardSighting> found = search(image, board);
    if (!found) {
      const std::string fault = faultOf(image);
      return fault.empty() ? found : Refusal{fault};
    }
    if (!enough(*found, board)) {
      return Refusal{"only " + std::to_string(found->ids.size()) +
                     " points of the board are seen, expected six or more in two rows and columns"};
    }
    const Sharpness sharpness = sharpnessOf(image, board, *found);
    if (sharpness.pitch_px <= 0.0) {
      const std::string fault = faultOf(image);
      return Refusal{fault.empty() ? "the board's edges have too little contrast" : fault};
    }
    const double allowed = std::max(kMostBlur_px, kMostBlur * sharpness.pitch_px);
    if (sharpness.blur_px > allowed) {
      return Refusal{blurText(sharpness.blur_px, allowed)};
    }
    return found;
  } catch (const cv::Exception& e) {
    return Refusal{"OpenCV could not search the image (" + e.err + ")"};
  }
}

}  // namespace ringhook
