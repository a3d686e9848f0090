#pragma once

/// \file
/// Grey values between pixels.

#include "core/image.h"

namespace ringhook {

/// Grey at (x, y) [px] by bilinear interpolation of the four pixels around it.
/// Precondition: 0 <= x < width - 1 and 0 <= y < height - 1.
inline double greyBetween(const GrayImage& image, double x, double y) {
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const double fx = x - x0;
  const double fy = y - y0;
  const std::uint8_t* upper = image.row(y0) + x0;
  const std::uint8_t* lower = upper + image.width;
  return (1.0 - fy) * ((1.0 - fx) * upper[0] + fx * upper[1]) +
         fy * ((1.0 - fx) * lower[0] + fx * lower[1]);
}

}  // namespace ringhook
