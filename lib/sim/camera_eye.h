#pragma once

/// \file
/// One simulated camera of the rig: from the drawn world to the grey image of a window. The chain
/// is the physical one: pinhole, light added up over the exposure, lens (blur, distortion,
/// vignetting), sensor (noise, 8 bits). For each exposure: begin, collect once per sub-instant,
/// develop.

#include <vector>

#include "sim/exposure.h"
#include "sim/lens_map.h"
#include "sim/renderer.h"
#include "sim/sensor_noise.h"

namespace ringhook {

class CameraEye {
 public:
  CameraEye(const CameraModel& camera, const Pose& fMc);

  [[nodiscard]] const Pinhole& pinhole() const { return eye_; }
  /// All of the image plane that the sensor can see.
  [[nodiscard]] const Window& plane() const { return plane_; }
  /// Of it, what the exposure that was begun shows.
  [[nodiscard]] const Window& seen() const { return seen_; }

  /// Starts an exposure of `window`, which lies in the full image.
  /// \param moving parts of the plane that change during the exposure, none overlapping another.
  void begin(const Window& window, const std::vector<Window>& moving);

  /// Adds the renderer's present scene. The first time the whole window is drawn, after that only
  /// what moves: the rest is the same.
  void collect(Renderer& renderer, double weight);

  /// The image of what was collected.
  [[nodiscard]] GrayImage develop(const SensorNoise& sensor, const ExposureKey& key);

 private:
  void drawWhole(Renderer& renderer, double weight);
  void addPart(Renderer& renderer, const Window& part, double weight);

  LensMap lens_;
  Pinhole eye_;
  Window plane_;
  Window window_;               // of the sensor
  Window seen_;                 // of the plane
  std::vector<Window> moving_;  // inside seen_
  bool begun_ = false;
  std::vector<std::uint16_t> drawn_;
  std::vector<float> grey_;  // of seen_, 255 is white
  std::vector<float> scratch_;
};

}  // namespace ringhook
