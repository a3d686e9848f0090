#pragma once

/// \file
/// Grey images and windows. Pixel coordinates put the centre of the first pixel at (0, 0), as
/// OpenCV and ViSP do. A window is a rectangle of whole pixels: a camera's readout region (AOI).

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ringhook {

struct Window {
  int x = 0;       ///< first column in the full image [px]
  int y = 0;       ///< first row in the full image [px]
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]

  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
  [[nodiscard]] bool contains(double px, double py) const {
    return px >= x && py >= y && px <= x + width - 1 && py <= y + height - 1;
  }
  [[nodiscard]] bool sameSize(const Window& other) const {
    return width == other.width && height == other.height;
  }
  bool operator==(const Window&) const = default;
};

/// Common part of both windows; empty() if there is none.
inline Window intersect(const Window& a, const Window& b) {
  const int x0 = std::max(a.x, b.x);
  const int y0 = std::max(a.y, b.y);
  const int x1 = std::min(a.x + a.width, b.x + b.width);
  const int y1 = std::min(a.y + a.height, b.y + b.height);
  return {x0, y0, std::max(0, x1 - x0), std::max(0, y1 - y0)};
}

/// Smallest window that holds both; an empty one adds nothing.
inline Window unite(const Window& a, const Window& b) {
  if (a.empty() || b.empty()) {
    return a.empty() ? b : a;
  }
  const int x0 = std::min(a.x, b.x);
  const int y0 = std::min(a.y, b.y);
  const int x1 = std::max(a.x + a.width, b.x + b.width);
  const int y1 = std::max(a.y + a.height, b.y + b.height);
  return {x0, y0, x1 - x0, y1 - y0};
}

/// 8-bit grey image, rows one after the other without padding.
struct GrayImage {
  int width = 0;                     ///< [px]
  int height = 0;                    ///< [px]
  std::vector<std::uint8_t> pixels;  ///< width * height values

  GrayImage() = default;
  GrayImage(int w, int h, std::uint8_t value = 0)
      : width(w),
        height(h),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

  [[nodiscard]] bool empty() const { return pixels.empty(); }
  [[nodiscard]] std::uint8_t* row(int y) {
    return pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
  [[nodiscard]] const std::uint8_t* row(int y) const {
    return pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

}  // namespace ringhook
