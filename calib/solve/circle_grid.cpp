#include "calib/solve/circle_grid.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "calib/solve/chessboard.h"
#include "calib/solve/cv_image.h"

namespace ringhook {
namespace {

constexpr int kLargestSearch_px = 1280;
constexpr double kSmallestDistance_px = 8.0;
constexpr int kOutline = 24;  // points that stand for a circle

struct Found {
  std::vector<Eigen::Vector2d> centres;  // [px]
  double scale = 1.0;                    // of the search: pixels of the image per pixel searched
};

cv::Ptr<cv::SimpleBlobDetector> blobDetector(const cv::Mat& mat, const Board& board) {
  cv::SimpleBlobDetector::Params params;
  params.minArea = 12.0F;
  params.maxArea = 2.0F * static_cast<float>(mat.total()) / static_cast<float>(board.size());
  params.minDistBetweenBlobs = 4.0F;
  params.minCircularity = 0.6F;
  params.minConvexity = 0.85F;
  return cv::SimpleBlobDetector::create(params);
}

// OpenCV's search, in an image that is made small enough for live pictures.
Found detect(const GrayImage& image, const Board& board) {
  const int reduction =
      (std::max(image.width, image.height) + kLargestSearch_px - 1) / kLargestSearch_px;
  cv::Mat mat = matOf(image);
  if (reduction > 1) {
    cv::Mat small;
    cv::resize(mat, small, cv::Size(image.width / reduction, image.height / reduction), 0.0, 0.0,
               cv::INTER_AREA);
    mat = small;
  }
  const int grid = board.kind == BoardKind::kCircles ? cv::CALIB_CB_SYMMETRIC_GRID
                                                     : cv::CALIB_CB_ASYMMETRIC_GRID;
  std::vector<cv::Point2f> centres;
  const cv::Size size(board.columns, board.rows);
  Found found;
  if (!cv::findCirclesGrid(mat, size, centres, grid, blobDetector(mat, board)) ||
      centres.size() != board.size()) {
    return found;
  }
  found.scale = static_cast<double>(image.width) / mat.cols;
  for (const cv::Point2f& p : centres) {
    found.centres.emplace_back(found.scale * (static_cast<double>(p.x) + 0.5) - 0.5,
                               found.scale * (static_cast<double>(p.y) + 0.5) - 0.5);
  }
  return found;
}

// Distance from each centre to its nearest neighbour [px].
std::vector<double> nearestDistances(const std::vector<Eigen::Vector2d>& centres) {
  std::vector<double> result(centres.size(), std::numeric_limits<double>::max());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    for (std::size_t j = 0; j < centres.size(); ++j) {
      if (i != j) {
        result[i] = std::min(result[i], (centres[i] - centres[j]).norm());
      }
    }
  }
  return result;
}

// Weighted first and second moments of a patch around a point.
struct Moments {
  double mass = 0.0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();      // [px]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // [px^2]
};

template <class Weight>
Moments momentsOf(const GrayImage& image, const Eigen::Vector2d& around, double reach,
                  const Weight& weight) {
  Moments m;
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  const int y0 = std::max(0, static_cast<int>(std::ceil(around.y() - reach)));
  const int y1 = std::min(image.height - 1, static_cast<int>(std::floor(around.y() + reach)));
  const int x0 = std::max(0, static_cast<int>(std::ceil(around.x() - reach)));
  const int x1 = std::min(image.width - 1, static_cast<int>(std::floor(around.x() + reach)));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Eigen::Vector2d d = Eigen::Vector2d(x, y) - around;
      const double w = weight(d, image.row(y)[x]);
      m.mass += w;
      m.centre += w * d;
      second += w * d * d.transpose();
    }
  }
  if (m.mass > 0.0) {
    m.centre /= m.mass;
    m.covariance = second / m.mass - m.centre * m.centre.transpose();
    m.centre += around;
  }
  return m;
}

// Centroid of the dark spot near `start`: its outline at half contrast gives an ellipse, and the
// grey values inside that ellipse and the blur around it give the centroid.
Eigen::Vector2d centroid(const GrayImage& image, const Eigen::Vector2d& start, double distance) {
  const double reach = 0.55 * distance;
  std::vector<std::uint8_t> ring;
  double darkest = 255.0;
  (void)momentsOf(image, start, reach, [&](const Eigen::Vector2d& d, std::uint8_t grey) {
    if (d.norm() > 0.45 * distance) {
      ring.push_back(grey);
    } else if (d.norm() < 0.1 * distance + 1.0) {
      darkest = std::min(darkest, static_cast<double>(grey));
    }
    return 0.0;
  });
  if (ring.empty()) {
    return start;
  }
  const auto middle = ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2);
  std::nth_element(ring.begin(), middle, ring.end());
  const double paper = *middle;
  const double half = 0.5 * (paper + darkest);
  const Moments outline =
      momentsOf(image, start, reach, [&](const Eigen::Vector2d& d, std::uint8_t grey) {
        return d.norm() < reach && grey < half ? 1.0 : 0.0;
      });
  if (!(outline.mass > 4.0) || !(outline.covariance.determinant() > 0.0)) {
    return start;
  }
  // A uniform ellipse of half axes a, b has the variances a^2 / 4, b^2 / 4.
  const double smaller = 2.0 * std::pow(outline.covariance.determinant(), 0.25);
  const double margin = 1.0 + std::max(2.5, 0.2 * smaller) / smaller;
  const Eigen::Matrix2d shape = outline.covariance.inverse() / (4.0 * margin * margin);
  const Moments grey_moments =
      momentsOf(image, outline.centre, reach, [&](const Eigen::Vector2d& d, std::uint8_t grey) {
        return d.dot(shape * d) < 1.0 ? paper - static_cast<double>(grey) : 0.0;
      });
  return grey_moments.mass > 0.0 ? grey_moments.centre : outline.centre;
}

Eigen::Vector2d seen(const CameraModel& camera, const Pose& cMt, const Eigen::Vector3d& point_t) {
  return projectNormalised(camera, (cMt * point_t).hnormalized());
}

}  // namespace

Outcome<BoardSighting> findCircles(const GrayImage& image, const Board& board) {
  Found found = detect(image, board);
  if (found.centres.empty()) {
    return Refusal{"no grid of " + std::to_string(board.columns) + "x" +
                   std::to_string(board.rows) + " dark circles is seen whole"};
  }
  if (board.kind == BoardKind::kCircles) {
    makeRightHanded(found.centres, board.columns, board.rows);
  }
  const std::vector<double> distances = nearestDistances(found.centres);
  if (*std::min_element(distances.begin(), distances.end()) < kSmallestDistance_px) {
    return Refusal{"the board's circles are less than 8 px apart"};
  }
  BoardSighting sighting;
  for (std::size_t i = 0; i < found.centres.size(); ++i) {
    sighting.ids.push_back(static_cast<int>(i));
    sighting.pixels.push_back(centroid(image, found.centres[i], distances[i]));
  }
  return sighting;
}

Eigen::Vector2d circleBias(const CameraModel& camera, const Pose& cMt,
                           const Eigen::Vector3d& centre_t, double diameter_m) {
  // A regular polygon of radius R has the second moments of a circle of radius r if
  // R^2 (2 + cos(2 pi / n)) / 3 = r^2; the bias is proportional to them.
  const double step = 2.0 * std::numbers::pi / kOutline;
  const double radius = 0.5 * diameter_m * std::sqrt(3.0 / (2.0 + std::cos(step)));
  const Eigen::Vector2d centre = seen(camera, cMt, centre_t);
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < kOutline; ++i) {
    const Eigen::Vector3d offset(radius * std::cos(i * step), radius * std::sin(i * step), 0.0);
    outline.push_back(seen(camera, cMt, centre_t + offset) - centre);
  }
  double area = 0.0;  // twice, and signed; likewise six times the first moment
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    const double cross = a.x() * b.y() - a.y() * b.x();
    area += cross;
    moment += cross * (a + b);
  }
  return moment / (3.0 * area);
}

}  // namespace ringhook
