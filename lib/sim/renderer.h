#pragma once

/// \file
/// Draws solids as exact pinhole cameras see them, without a display server. MuJoCo says where
/// everything is; the picture is drawn here, since MuJoCo's own renderer redraws its shadow map for
/// every rectangle, shows shadows only of what is in view, and lights vertices, not pixels.
/// Antialiasing: 4 samples a pixel. One shadow map an instant serves both cameras.
///
/// The whole image plane is one canvas, and a window of it is the same draw with everything outside
/// the window left out before shading: each pixel is the same, bit by bit, whatever the window.
/// Brightness is linear. Lens distortion, vignetting and noise are laid over it by lens_map.h and
/// sensor_noise.h.

#include <cstdint>
#include <memory>
#include <vector>

#include "core/image.h"
#include "sim/scene_light.h"
#include "sim/shadow_part.h"

struct mjModel_;

namespace ringhook {

/// 8-bit colour, 4 bytes a pixel (red, green, blue, unused), rows from the top.
struct ColourImage {
  int width = 0;                     ///< [px]
  int height = 0;                    ///< [px]
  std::vector<std::uint8_t> pixels;  ///< 4 * width * height values
};

class Renderer {
 public:
  /// Grey value of a surface of brightness 1, which fills the sensor's well; there is room above.
  static constexpr int kWhite = 16384;

  /// \param width, height of the largest plane that will be drawn [px]. The model must outlive the
  /// renderer. Throws DeviceError if there is no OpenGL 3.3.
  Renderer(const mjModel_& model, const SceneLight& light, int width, int height);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Takes over the solids and draws their shadows; call once per instant, before any draws.
  /// \param seen what will be drawn of this instant; shadows are drawn where that can show them.
  void setScene(const std::vector<Solid>& solids, const std::vector<SeenPart>& seen);

  /// Draws `part` of the plane, row after row. `plane` is the whole rectangle of the image plane
  /// that the camera can ever see; `part` lies in it.
  void drawGrey(const Pinhole& eye, const Window& plane, const Window& part,
                std::vector<std::uint16_t>& grey);

  /// Draws the plane in colour, for looking at.
  void drawColour(const Pinhole& eye, const Window& plane, ColourImage& image);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ringhook
