#include "tracking/edge_site.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/grey_between.h"

namespace ringhook {
namespace {

constexpr int kMaxReach = 4;

/// Difference across the normal at `p`, averaged along the line [grey levels per pixel].
double across(const GrayImage& image, const Eigen::Vector2d& p, const Eigen::Vector2d& normal) {
  const Eigen::Vector2d along(-normal.y(), normal.x());
  double sum = 0.0;
  for (int t = -1; t <= 1; ++t) {
    const Eigen::Vector2d a = p + normal + t * along;
    const Eigen::Vector2d b = p - normal + t * along;
    sum += greyBetween(image, a.x(), a.y()) - greyBetween(image, b.x(), b.y());
  }
  return sum / 6.0;
}

}  // namespace

std::optional<ImageLine> projectEdge(const PinholeView& camera, const Pose& c1Mo,
                                     const Eigen::Vector3d& start_o, const Eigen::Vector3d& end_o) {
  const auto a = camera.project(c1Mo * start_o);
  const auto b = camera.project(c1Mo * end_o);
  if (!a || !b || (*b - *a).norm() < 1e-6) {
    return std::nullopt;
  }
  const Eigen::Vector2d along = (*b - *a).normalized();
  const Eigen::Vector2d normal(-along.y(), along.x());
  return ImageLine{normal, normal.dot(*a)};
}

std::optional<RefinedSite> refineAcross(const GrayImage& image, const Window& window,
                                        const Eigen::Vector2d& pixel, const Eigen::Vector2d& normal,
                                        int reach_px, double least_contrast) {
  const Eigen::Vector2d p = pixel - Eigen::Vector2d(window.x, window.y);
  const int reach = std::clamp(reach_px, 1, kMaxReach);
  const double margin = reach + 4.0;
  if (p.x() < margin || p.y() < margin || p.x() >= image.width - margin ||
      p.y() >= image.height - margin) {
    return std::nullopt;
  }
  std::array<double, 2 * kMaxReach + 3> profile{};
  const int samples = 2 * reach + 3;
  for (int i = 0; i < samples; ++i) {
    profile[static_cast<std::size_t>(i)] = across(image, p + (i - reach - 1) * normal, normal);
  }
  const auto first = profile.begin();
  const auto peak = std::max_element(first, first + samples,
                                     [](double a, double b) { return std::abs(a) < std::abs(b); });
  if (peak == first || peak == first + samples - 1 || std::abs(*peak) < least_contrast) {
    return std::nullopt;
  }
  const double sign = *peak < 0.0 ? -1.0 : 1.0;
  const double curvature = sign * (*(peak - 1) - 2.0 * *peak + *(peak + 1));
  const double slope = 0.5 * sign * (*(peak + 1) - *(peak - 1));
  const double vertex = curvature < 0.0 ? std::clamp(-slope / curvature, -0.5, 0.5) : 0.0;
  const double shift = static_cast<double>(peak - first) - reach - 1 + vertex;
  RefinedSite refined;
  refined.pixel = pixel + shift * normal;
  refined.contrast = std::abs(*peak);
  const Eigen::Vector2d along(-normal.y(), normal.x());
  refined.direction = std::atan2(std::abs(across(image, p + shift * normal, along)), *peak * sign);
  return refined;
}

double robustSigma(std::vector<double> values) {
  if (values.empty()) {
    return 0.0;
  }
  std::transform(values.begin(), values.end(), values.begin(),
                 [](double v) { return std::abs(v); });
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return 1.4826 * *middle;
}

}  // namespace ringhook
