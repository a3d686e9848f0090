#include "tracking/edge_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/error.h"

namespace ringhook {
namespace {

/// Number of the direction sector of a line with this direction, 0 to kDirections - 1: sector n is
/// centred on n * 22.5 degrees. Slopes are compared, for a search asks millions of times.
int sector(double x, double y) {
  // Tangents of the sectors' upper bounds, -78.75 to 78.75 degrees.
  constexpr std::array<double, 8> kBounds{-5.0273, -1.4966, -0.66818, -0.19891,
                                          0.19891, 0.66818, 1.4966,   5.0273};
  const double slope = x == 0.0 ? 1e9 : y / x;
  int above = 0;
  for (const double bound : kBounds) {
    above += slope > bound ? 1 : 0;
  }
  return (above + EdgeField::kDirections / 2) % EdgeField::kDirections;
}

/// Edge pixels (0) of each direction on 255; an edge counts for its two nearest sectors.
std::array<cv::Mat, EdgeField::kDirections> edgeMasks(const cv::Mat& grey) {
  cv::Mat dx;
  cv::Mat dy;
  cv::Sobel(grey, dx, CV_16S, 1, 0);
  cv::Sobel(grey, dy, CV_16S, 0, 1);
  // Sobel's gain is 8: an edge must rise by 4 grey levels a pixel, its continuation by 2.
  cv::Mat edges;
  cv::Canny(dx, dy, edges, 16.0, 32.0, true);
  std::array<cv::Mat, EdgeField::kDirections> masks;
  for (cv::Mat& mask : masks) {
    mask = cv::Mat(grey.size(), CV_8U, cv::Scalar(255));
  }
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) {
      if (edges.at<std::uint8_t>(y, x) == 0) {
        continue;
      }
      const double gx = dx.at<short>(y, x);
      const double gy = dy.at<short>(y, x);
      const double quarter = std::numbers::pi / EdgeField::kDirections / 4.0;
      const double c = std::cos(quarter);
      const double s = std::sin(quarter);
      const int a = sector(-gy * c - gx * s, gx * c - gy * s);
      const int b = sector(-gy * c + gx * s, gx * c + gy * s);
      masks[static_cast<std::size_t>(a)].at<std::uint8_t>(y, x) = 0;
      masks[static_cast<std::size_t>(b)].at<std::uint8_t>(y, x) = 0;
    }
  }
  return masks;
}

}  // namespace

EdgeField::EdgeField(const RectifiedView& view, double cutoff_px)
    : camera_(view.camera), window_(view.window) {
  width_ = view.image.width / kReduction;
  height_ = view.image.height / kReduction;
  if (width_ < 4 || height_ < 4) {
    width_ = height_ = 0;
    return;
  }
  try {
    const cv::Mat full(view.image.height, view.image.width, CV_8U,
                       const_cast<std::uint8_t*>(view.image.pixels.data()));
    cv::Mat grey;
    cv::resize(full(cv::Rect(0, 0, width_ * kReduction, height_ * kReduction)), grey,
               cv::Size(width_, height_), 0, 0, cv::INTER_AREA);
    const auto masks = edgeMasks(grey);
    for (std::size_t i = 0; i < masks.size(); ++i) {
      cv::Mat distance;
      cv::distanceTransform(masks[i], distance, cv::DIST_L2, 3);
      cv::Mat near;
      distance.convertTo(near, CV_8U, -255.0 * kReduction / cutoff_px, 255.0);
      maps_[i].assign(near.datastart, near.dataend);
    }
  } catch (const cv::Exception& e) {
    throw Error(std::string("hook search failed inside OpenCV: ") + e.what());
  }
}

int EdgeField::nearness(const Eigen::Vector2d& pixel, const Eigen::Vector2d& direction) const {
  const double half = 0.5 * (kReduction - 1);
  const double u = (pixel.x() - window_.x - half) / kReduction + 0.5;
  const double v = (pixel.y() - window_.y - half) / kReduction + 0.5;
  if (!(u >= 0.0 && v >= 0.0 && u < width_ && v < height_)) {
    return 0;
  }
  const std::size_t at =
      static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  return maps_[static_cast<std::size_t>(sector(direction.x(), direction.y()))][at];
}

}  // namespace ringhook
