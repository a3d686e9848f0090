#pragma once

/// \file
/// Grey images as OpenCV sees them, for the sources behind the fence: no copy, read only.

#include <opencv2/core.hpp>

#include "core/image.h"

namespace ringhook {

/// The image's own pixels; `image` must outlive the result, which must not be written to.
inline cv::Mat matOf(const GrayImage& image) {
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())};
}

}  // namespace ringhook
