#include "prediction/search_window.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "prediction/chi_square.h"

namespace ringhook {
namespace {

struct Box {
  Eigen::Array2d low;   // [px]
  Eigen::Array2d high;  // [px]
};

struct Span {
  int first;
  int size;
};

// Standard deviations of a point's pixel; `point_c` in the camera of `view`, z > 0.
Eigen::Array2d pixelSigmas(const PinholeView& view, const Eigen::Matrix3d& cRo,
                           const Eigen::Vector3d& point_c, const Eigen::Vector3d& point_o,
                           const Covariance6& covariance) {
  const double z = point_c.z();
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << view.fx / z, 0.0, -view.fx * point_c.x() / (z * z),  //
      0.0, view.fy / z, -view.fy * point_c.y() / (z * z);
  Eigen::Matrix<double, 3, 6> by_twist;
  by_twist << cRo, -cRo * skew(point_o);
  const Eigen::Matrix<double, 2, 6> H = by_point * by_twist;
  const Eigen::Matrix2d S = H * covariance * H.transpose();
  return S.diagonal().cwiseMax(0.0).cwiseSqrt().array();
}

std::optional<Box> grownBox(const PinholeView& view, const Pose& c1Mo,
                            const Covariance6& covariance,
                            std::span<const Eigen::Vector3d> points_o,
                            const SearchWindowOptions& options) {
  const Pose cMo = view.cMc1 * c1Mo;
  std::optional<Box> box;
  for (const Eigen::Vector3d& point_o : points_o) {
    const auto pixel = view.project(c1Mo * point_o);
    if (!pixel) {
      continue;
    }
    const Eigen::Array2d reach =
        options.sigmas * pixelSigmas(view, cMo.linear(), cMo * point_o, point_o, covariance) +
        options.margin_px;
    const Box own{pixel->array() - reach, pixel->array() + reach};
    box = box ? Box{box->low.min(own.low), box->high.max(own.high)} : own;
  }
  return box;
}

// Whole aligned pixels [first, first + size) around [low, high], inside [0, image).
Span fit(double low, double high, int image, const SearchWindowOptions& options) {
  const int step = std::max(1, options.alignment_px);
  const int whole = image / step * step;
  const double shortest = std::min(options.min_size_px, whole);
  const double longest = std::clamp(options.max_size_px / step * step, step, std::max(step, whole));
  const double middle = 0.5 * (low + high);
  const double half = 0.5 * std::clamp(high - low, shortest - 1.0, longest - 1.0);
  const double first = std::clamp(middle - half, 0.0, std::max(0.0, image - 2.0 * half - 1.0));
  const double last = std::min(first + 2.0 * half, image - 1.0);
  int begin = static_cast<int>(std::floor(first)) / step * step;
  int size = (static_cast<int>(std::ceil(last)) - begin) / step * step + step;
  size = std::min({size, static_cast<int>(longest), whole});
  begin = std::min(begin, whole - size);
  return {begin, size};
}

}  // namespace

double sigmasForProbability(double probability) {
  return std::sqrt(chiSquareQuantile(probability, 6.0));
}

Window searchWindow(const PinholeView& view, const Pose& c1Mo, const Covariance6& covariance,
                    std::span<const Eigen::Vector3d> points_o, const SearchWindowOptions& options) {
  const auto box = grownBox(view, c1Mo, covariance, points_o, options);
  const Eigen::Array2d last(view.width - 1.0, view.height - 1.0);
  const bool meets = box && (box->low <= last).all() && (box->high >= 0.0).all();
  if (!meets) {
    return {};
  }
  const Eigen::Array2d low = box->low.max(0.0);
  const Eigen::Array2d high = box->high.min(last);
  const Span x = fit(low.x(), high.x(), view.width, options);
  const Span y = fit(low.y(), high.y(), view.height, options);
  return {x.first, y.first, x.size, y.size};
}

}  // namespace ringhook
