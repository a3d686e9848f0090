#include "sim/lens_map.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kStep = 8;    // pixels between nodes
constexpr int kMargin = 3;  // pixels around a window, for interpolation, blur and rounding

LensMap::Sample between(const LensMap::Sample& a, const LensMap::Sample& b, float s) {
  return {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), a.light + s * (b.light - a.light)};
}

}  // namespace

LensMap::LensMap(const CameraModel& camera)
    : focal_px_(camera.K(0, 0)),
      columns_((camera.width + kStep - 1) / kStep + 1),
      rows_((camera.height + kStep - 1) / kStep + 1) {
  nodes_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (int j = 0; j < rows_; ++j) {
    for (int i = 0; i < columns_; ++i) {
      const Outcome<Eigen::Vector2d> ray = undistortPixel(camera, {i * kStep, j * kStep});
      if (!ray) {
        throw Error("the lens model has no ray for pixel " + std::to_string(i * kStep) + ", " +
                    std::to_string(j * kStep) + ": its distortion must stay one-to-one");
      }
      const double cos2 = 1.0 / (1.0 + ray->squaredNorm());
      nodes_.push_back({static_cast<float>(focal_px_ * ray->x()),
                        static_cast<float>(focal_px_ * ray->y()), static_cast<float>(cos2 * cos2)});
    }
  }
}

Window LensMap::planeWindow(const Window& window) const {
  const int i1 = (window.x + window.width - 1) / kStep + 1;
  const int j1 = (window.y + window.height - 1) / kStep + 1;
  float left = node(window.x / kStep, window.y / kStep).x;
  float right = left;
  float top = node(window.x / kStep, window.y / kStep).y;
  float bottom = top;
  for (int j = window.y / kStep; j <= j1; ++j) {
    for (int i = window.x / kStep; i <= i1; ++i) {
      const Sample& corner = node(i, j);
      left = std::min(left, corner.x);
      right = std::max(right, corner.x);
      top = std::min(top, corner.y);
      bottom = std::max(bottom, corner.y);
    }
  }
  const int x = static_cast<int>(std::floor(left)) - kMargin;
  const int y = static_cast<int>(std::floor(top)) - kMargin;
  return {x, y, static_cast<int>(std::ceil(right)) + kMargin - x + 1,
          static_cast<int>(std::ceil(bottom)) + kMargin - y + 1};
}

void LensMap::row(int x0, int y, std::vector<Sample>& samples) const {
  const int j = y / kStep;
  const float t = static_cast<float>(y % kStep) / kStep;
  int column = -1;
  Sample left;
  Sample right;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const int x = x0 + static_cast<int>(k);
    if (x / kStep != column) {
      column = x / kStep;
      left = between(node(column, j), node(column, j + 1), t);
      right = between(node(column + 1, j), node(column + 1, j + 1), t);
    }
    samples[k] = between(left, right, static_cast<float>(x % kStep) / kStep);
  }
}

}  // namespace ringhook
