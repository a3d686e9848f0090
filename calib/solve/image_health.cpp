#include "calib/solve/image_health.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace ringhook {
namespace {

constexpr int kSmallestContrast = 20;  // grey values
constexpr int kDark = 45;              // the brightest hundredth of a picture that is too dark
constexpr int kWhite = 250;
constexpr double kMostWhite = 0.5;  // part of the picture

double grey(const GrayImage& image, const Eigen::Vector2d& p) {
  const double x = std::clamp(p.x(), 0.0, image.width - 1.001);
  const double y = std::clamp(p.y(), 0.0, image.height - 1.001);
  const auto column = static_cast<int>(x);
  const auto row = static_cast<int>(y);
  const double fx = x - column;
  const double fy = y - row;
  const std::uint8_t* upper = image.row(row) + column;
  const std::uint8_t* lower = image.row(std::min(row + 1, image.height - 1)) + column;
  return (1 - fy) * ((1 - fx) * upper[0] + fx * upper[1]) +
         fy * ((1 - fx) * lower[0] + fx * lower[1]);
}

}  // namespace

std::string exposureFault(const GrayImage& image) {
  if (image.empty()) {
    return "the image is empty";
  }
  std::array<std::size_t, 256> histogram{};
  for (const std::uint8_t value : image.pixels) {
    ++histogram[value];
  }
  const auto total = static_cast<double>(image.pixels.size());
  const auto quantile = [&](double part) {
    double sum = 0.0;
    int value = 0;
    while (value < 255 &&
           sum + static_cast<double>(histogram[static_cast<std::size_t>(value)]) <= part * total) {
      sum += static_cast<double>(histogram[static_cast<std::size_t>(value++)]);
    }
    return value;
  };
  const auto [dark, bright] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  if (*bright == *dark) {
    return "all pixels are " + std::to_string(*dark) + ": was the shutter closed or a cable off?";
  }
  if (quantile(0.99) < kDark) {
    return "too dark: 99 % of the pixels are below " + std::to_string(quantile(0.99) + 1) +
           " of 255, expected white paper above 100 (more light or a longer exposure)";
  }
  const double white = std::accumulate(histogram.begin() + kWhite, histogram.end(), 0.0);
  if (white > kMostWhite * total) {
    return "overexposed: " + std::to_string(std::lround(100.0 * white / total)) +
           " % of the pixels are white (less light or a shorter exposure)";
  }
  if (*bright - *dark < kSmallestContrast) {
    return "no contrast: all pixels lie between " + std::to_string(*dark) + " and " +
           std::to_string(*bright);
  }
  return "";
}

double edgeBlur(const GrayImage& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double length = (b - a).norm();
  const auto steps = static_cast<int>(std::ceil(2.0 * length));
  if (image.width < 2 || image.height < 2 || steps < 4) {
    return std::numeric_limits<double>::infinity();
  }
  std::vector<double> profile;
  for (int i = 0; i <= steps; ++i) {
    profile.push_back(grey(image, a + (b - a) * (static_cast<double>(i) / steps)));
  }
  const auto [low, high] = std::minmax_element(profile.begin(), profile.end());
  const double contrast = *high - *low;
  if (contrast < kSmallestContrast) {
    return std::numeric_limits<double>::infinity();
  }
  double slope = 0.0;  // over a whole pixel, so that noise does not pass for sharpness
  for (std::size_t i = 2; i < profile.size(); ++i) {
    slope = std::max(slope, std::abs(profile[i] - profile[i - 2]) * steps / (2.0 * length));
  }
  return contrast / (slope * std::sqrt(2.0 * std::numbers::pi));
}

double strongestEdgesBlur(const GrayImage& image) {
  constexpr int kReach_px = 15;
  constexpr std::size_t kEdges = 200;
  struct Edge {
    double slope = 0.0;
    Eigen::Vector2d at;
    Eigen::Vector2d across;
  };
  std::vector<Edge> edges;
  for (int y = kReach_px; y < image.height - kReach_px; y += 2) {
    for (int x = kReach_px; x < image.width - kReach_px; x += 2) {
      const Eigen::Vector2d slope(image.row(y)[x + 1] - image.row(y)[x - 1],
                                  image.row(y + 1)[x] - image.row(y - 1)[x]);
      if (slope.norm() > 4.0) {
        edges.push_back({slope.norm(), {x, y}, slope.normalized()});
      }
    }
  }
  const std::size_t kept = std::min(kEdges, edges.size());
  std::partial_sort(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(kept), edges.end(),
                    [](const Edge& a, const Edge& b) { return a.slope > b.slope; });
  std::vector<double> blurs;
  for (std::size_t i = 0; i < kept; ++i) {
    const Eigen::Vector2d reach = kReach_px * edges[i].across;
    const double blur = edgeBlur(image, edges[i].at - reach, edges[i].at + reach);
    if (std::isfinite(blur)) {
      blurs.push_back(blur);
    }
  }
  if (blurs.size() < kEdges / 4) {
    return 0.0;
  }
  std::sort(blurs.begin(), blurs.end());
  return blurs[blurs.size() / 2];
}

}  // namespace ringhook
