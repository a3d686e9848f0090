#pragma once

/// \file
/// From a sensor's pixels to the ideal image plane that the renderer draws: for every pixel of the
/// distorted image the place where its ray meets the plane at distance f, and how much light the
/// lens lets through there. The inverse of the lens model is solved on every 8th pixel and
/// interpolated linearly between: for k1 = -0.12 and f = 2500 px that is right to 0.002 px.
/// Vignetting: the natural cos^4 law (Horn, "Robot Vision", 1986, section 10.4).

#include <vector>

#include "core/image.h"
#include "rig/camera_model.h"

namespace ringhook {

class LensMap {
 public:
  /// Throws Error if some pixel of the image has no ray in the lens model.
  explicit LensMap(const CameraModel& camera);

  /// Focal length of the ideal plane [px].
  [[nodiscard]] double focalPx() const { return focal_px_; }

  /// Smallest rectangle of the ideal plane (origin on the optical axis) from which all pixels of
  /// `window` can be sampled with their neighbours.
  [[nodiscard]] Window planeWindow(const Window& window) const;

  /// One pixel's place in the ideal plane, and the light that reaches it.
  struct Sample {
    float x = 0.0F;      ///< from the optical axis [px of the plane]
    float y = 0.0F;      ///< from the optical axis [px of the plane]
    float light = 1.0F;  ///< cos^4 of the ray's angle to the axis
  };

  /// Samples of pixels x0 .. x0 + samples.size() - 1 of row y.
  void row(int x0, int y, std::vector<Sample>& samples) const;

 private:
  [[nodiscard]] const Sample& node(int i, int j) const {
    return nodes_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(i)];
  }

  double focal_px_;
  int columns_;
  int rows_;
  std::vector<Sample> nodes_;
};

}  // namespace ringhook
