#pragma once

/// \file
/// What a stereo camera delivers, and the same after rectification.

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/pinhole_view.h"
#include "core/time.h"

namespace ringhook {

/// One pair of images as read out. A sequence of one camera leaves `right` empty.
struct StereoFrame {
  Time time;                ///< mid-exposure of the pair
  std::uint64_t index = 0;  ///< frame number of the source; lost frames leave a gap
  GrayImage left;           ///< pixels of left_window
  GrayImage right;          ///< pixels of right_window; empty for a mono source
  Window left_window;       ///< place of `left` in the full (distorted) image [px]
  Window right_window;      ///< place of `right` in the full (distorted) image [px]
};

/// One image after undistortion and rectification: pixels of `window` in an ideal pinhole camera.
struct RectifiedView {
  PinholeView camera;
  Window window;    ///< place of `image` in the camera's full rectified image [px]
  GrayImage image;  ///< pixels of `window`
};

/// One (mono) or two (left, right) rectified views of one instant.
struct RectifiedFrame {
  Time time;                         ///< mid-exposure
  std::vector<RectifiedView> views;  ///< left first
};

}  // namespace ringhook
