#pragma once

/// \file
/// The combined map of one camera: for every rectified pixel of a window the raw position, in
/// OpenCV's fixed-point form (whole pixel, and an index of the fraction in 1/32 px per axis).

#include <cstdint>
#include <optional>
#include <vector>

#include "core/image.h"
#include "core/pinhole_view.h"
#include "rig/camera_model.h"

namespace ringhook {

/// One camera turned into a rectified view by a rotation of its frame.
struct TurnedCamera {
  CameraModel raw;
  Eigen::Matrix3d rRc = Eigen::Matrix3d::Identity();  ///< camera in its rectified frame
  PinholeView view;                                   ///< the rectified camera
  double fold_radius = 0.0;                           ///< foldRadius(raw)
};

/// Raw position [px] of a rectified pixel; nothing where the lens model has no image of it.
std::optional<Eigen::Vector2d> rawPosition(const TurnedCamera& camera,
                                           const Eigen::Vector2d& rectified);

class RectifyMap {
 public:
  /// Map of the rectified pixels of `window`; all positions at once.
  RectifyMap(const TurnedCamera& camera, const Window& window);

  [[nodiscard]] const Window& window() const { return window_; }

  /// True if the rectified pixel (x, y), inside window(), can be interpolated from the pixels of
  /// the raw window alone.
  [[nodiscard]] bool covered(int x, int y, const Window& raw) const;

  /// Grey values of `target` (inside window()) from `image`, the pixels of the raw window `raw`.
  [[nodiscard]] GrayImage remap(const GrayImage& image, const Window& raw,
                                const Window& target) const;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const;

  Window window_;
  std::vector<std::int16_t> whole_;      // x and y of the upper left neighbour [px]
  std::vector<std::uint16_t> fraction_;  // 32 * (y fraction) + (x fraction) [1/32 px]
};

}  // namespace ringhook
