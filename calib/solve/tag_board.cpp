#include "calib/solve/tag_board.h"

#include <algorithm>
#include <array>
#include <map>
#include <opencv2/calib3d.hpp>
#include <set>

#include "calib/solve/cv_image.h"
#include "tracking/tag_detector.h"

namespace ringhook {
namespace {

constexpr double kReduction = 2.0;      // of the image in which squares are searched
constexpr int kReducedFrom_px = 1200;   // images at least this large
constexpr double kSmallestMargin = 15;  // of a code that is believed [grey levels]
constexpr double kFarthest = 0.3;       // of a corner from its prediction [tag sides]
constexpr double kBorder_px = 5.0;      // what the fit of a side looks at beyond a corner

// A tag that reaches the border: its side is cut there, and a corner may be extrapolated.
bool cutOff(const GrayImage& image, const TagDetection& tag) {
  return std::any_of(tag.corners.begin(), tag.corners.end(), [&](const Eigen::Vector2d& p) {
    return !(p.x() >= kBorder_px && p.y() >= kBorder_px && p.x() <= image.width - 1 - kBorder_px &&
             p.y() <= image.height - 1 - kBorder_px);
  });
}

std::vector<TagDetection> tagsOf(const GrayImage& image, const Board& board) {
  TagDetector detector(board.family, 1, true);
  const bool large = std::max(image.width, image.height) >= kReducedFrom_px;
  std::vector<TagDetection> tags =
      detector.detect(image, {0, 0, image.width, image.height}, large ? kReduction : 1.0);
  std::map<int, int> count;
  for (const TagDetection& tag : tags) {
    ++count[tag.id];
  }
  std::erase_if(tags, [&](const TagDetection& tag) {
    return tag.id >= board.columns * board.rows || count[tag.id] > 1 || tag.hamming > 1 ||
           tag.decision_margin < kSmallestMargin || cutOff(image, tag);
  });
  std::sort(tags.begin(), tags.end(),
            [](const TagDetection& a, const TagDetection& b) { return a.id < b.id; });
  return tags;
}

Eigen::Vector2d middle(const TagDetection& tag) {
  return 0.25 * (tag.corners[0] + tag.corners[1] + tag.corners[2] + tag.corners[3]);
}

// The board's plane [m] to the image, from the tags' middles.
cv::Mat planeOf(const std::vector<TagDetection>& tags, const std::vector<Eigen::Vector3d>& points) {
  std::vector<cv::Point2d> plane;
  std::vector<cv::Point2d> pixels;
  for (const TagDetection& tag : tags) {
    const auto first = 4 * static_cast<std::size_t>(tag.id);
    const Eigen::Vector3d p = 0.5 * (points[first] + points[first + 2]);
    plane.emplace_back(p.x(), p.y());
    pixels.emplace_back(middle(tag).x(), middle(tag).y());
  }
  return cv::findHomography(plane, pixels);
}

std::array<Eigen::Vector2d, 4> predicted(const cv::Mat& H, const Eigen::Vector3d* points) {
  std::vector<cv::Point2d> in;
  for (int i = 0; i < 4; ++i) {
    in.emplace_back(points[i].x(), points[i].y());
  }
  std::vector<cv::Point2d> out;
  cv::perspectiveTransform(in, out, H);
  return {Eigen::Vector2d(out[0].x, out[0].y), Eigen::Vector2d(out[1].x, out[1].y),
          Eigen::Vector2d(out[2].x, out[2].y), Eigen::Vector2d(out[3].x, out[3].y)};
}

// The detected corner nearest to each predicted one; nothing if one is taken twice or far off.
bool assign(const TagDetection& tag, const std::array<Eigen::Vector2d, 4>& wanted,
            BoardSighting& sighting) {
  const double side = (wanted[0] - wanted[1]).norm();
  std::set<std::size_t> taken;
  std::array<Eigen::Vector2d, 4> pixels;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto nearest =
        std::min_element(tag.corners.begin(), tag.corners.end(), [&](const auto& a, const auto& b) {
          return (a - wanted[k]).squaredNorm() < (b - wanted[k]).squaredNorm();
        });
    if ((*nearest - wanted[k]).norm() > kFarthest * side ||
        !taken.insert(static_cast<std::size_t>(nearest - tag.corners.begin())).second) {
      return false;
    }
    pixels[k] = *nearest;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    sighting.ids.push_back(4 * tag.id + static_cast<int>(k));
    sighting.pixels.push_back(pixels[k]);
  }
  return true;
}

bool spread(const std::vector<TagDetection>& tags, const Board& board) {
  std::set<int> columns;
  std::set<int> rows;
  for (const TagDetection& tag : tags) {
    columns.insert(tag.id % board.columns);
    rows.insert(tag.id / board.columns);
  }
  return tags.size() >= 4 && columns.size() >= 2 && rows.size() >= 2;
}

}  // namespace

Outcome<BoardSighting> findTagBoard(const GrayImage& image, const Board& board) {
  const std::vector<TagDetection> tags = tagsOf(image, board);
  if (!spread(tags, board)) {
    return Refusal{"only " + std::to_string(tags.size()) + " of the board's " + board.family +
                   " tags are seen, expected four or more in two rows and two columns"};
  }
  const std::vector<Eigen::Vector3d> points = board.points();
  const cv::Mat H = planeOf(tags, points);
  BoardSighting sighting;
  for (const TagDetection& tag : tags) {
    const auto first = 4 * static_cast<std::size_t>(tag.id);
    if (H.empty() || !assign(tag, predicted(H, &points[first]), sighting)) {
      return Refusal{"tag " + std::to_string(tag.id) +
                     " does not lie where the board says: check columns, rows, side and gap"};
    }
  }
  return sighting;
}

}  // namespace ringhook
