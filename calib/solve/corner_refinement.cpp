#include "calib/solve/corner_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "calib/solve/cv_image.h"
#include "calib/solve/saddle_fit.h"

namespace ringhook {
namespace {

constexpr double kLargestShare = 0.3;
constexpr double kShareOfGap = 0.85;
constexpr int kSmallestWindow_px = 2;

}  // namespace

double windowShare(double gap) { return std::min(kLargestShare, kShareOfGap * gap); }

int windowFor(double spacing_px, double share) {
  return std::max(kSmallestWindow_px, static_cast<int>(std::floor(share * spacing_px)));
}

std::vector<double> gridSpacings(const Corners& grid, int columns, int rows) {
  const auto at = [&](int row, int column) -> const Eigen::Vector2d& {
    return grid[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(column)];
  };
  const auto spacing = [&](int row, int column) {
    double smallest = std::numeric_limits<double>::max();
    for (const auto& [dr, dc] : {std::array{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}) {
      const int r = row + dr;
      const int c = column + dc;
      if (r < 0 || c < 0 || r >= rows || c >= columns) {
        continue;
      }
      const Eigen::Vector2d a = at(r, column) - at(row, column);
      const Eigen::Vector2d b = at(row, c) - at(row, column);
      const double area = std::abs(a.x() * b.y() - a.y() * b.x());
      smallest = std::min(smallest, area / std::max({a.norm(), b.norm(), 1e-9}));
    }
    return smallest;
  };
  std::vector<double> spacings;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      spacings.push_back(spacing(r, c));
    }
  }
  return spacings;
}

void refineCorners(const GrayImage& image, const std::vector<int>& windows, Corners& corners) {
  const cv::Mat mat = matOf(image);
  const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::vector<cv::Point2f> one{
        cv::Point2f(static_cast<float>(corners[i].x()), static_cast<float>(corners[i].y()))};
    cv::cornerSubPix(mat, one, cv::Size(windows[i], windows[i]), cv::Size(-1, -1), stop);
    const Eigen::Vector2d start(one[0].x, one[0].y);
    corners[i] = fitSaddle(image, start, windows[i]).value_or(start);
  }
}

}  // namespace ringhook
