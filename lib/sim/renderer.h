#pragma once

/// \file
/// Draws the MuJoCo world as an exact pinhole camera sees it, one rectangle of the image plane at
/// a time, without a display server. The image plane is an endless grid of square pixels whose
/// pixel (0, 0) has its centre on the optical axis: x/z = i / f, y/z = j / f. A rectangle of it is
/// drawn with an off-axis frustum, so a small window costs only its own pixels and shows the same
/// samples as the full image. Antialiasing: 4 samples a pixel. No shadows, no reflections.
/// Lens distortion, vignetting and noise are laid over it by lens_map.h and sensor_noise.h.

#include <cstdint>
#include <memory>
#include <vector>

#include "core/image.h"
#include "core/pose.h"

struct mjModel_;
struct mjData_;

namespace ringhook {

/// A rectangle of a pinhole's image plane.
struct PlaneView {
  Pose wMc;               ///< camera in the world: x right, y down, z forward
  double focal_px = 0.0;  ///< [px]
  Window window;          ///< pixels of the grid that is centred on the optical axis
};

/// 8-bit colour, 4 bytes a pixel (red, green, blue, unused), rows from the top.
struct ColourImage {
  int width = 0;                     ///< [px]
  int height = 0;                    ///< [px]
  std::vector<std::uint8_t> pixels;  ///< 4 * width * height values
};

class Renderer {
 public:
  /// The model must outlive the renderer. Throws DeviceError if there is no OpenGL.
  explicit Renderer(const mjModel_& model);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Takes over all positions; call once per instant, before any number of draws.
  void updateScene(mjData_& data);

  /// Draws what updateScene last took over; large rectangles in tiles.
  void draw(const PlaneView& view, ColourImage& image);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ringhook
