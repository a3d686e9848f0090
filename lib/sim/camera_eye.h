#pragma once

/// \file
/// One simulated camera of the rig: from the drawn world to the grey image of a window. The chain
/// is the physical one: pinhole, lens (blur, distortion, vignetting), sensor (noise, 8 bits).
/// Left out: motion blur; 0.5 ms of exposure smear 0.1 px at 0.1 m/s.

#include <vector>

#include "sim/lens_map.h"
#include "sim/renderer.h"
#include "sim/sensor_noise.h"

namespace ringhook {

class CameraEye {
 public:
  CameraEye(const CameraModel& camera, const Pose& wMc);

  /// Pixels of `window`, which lies in the full image.
  [[nodiscard]] GrayImage expose(Renderer& renderer, const SensorNoise& sensor,
                                 const ExposureKey& key, const Window& window);

 private:
  void develop(const SensorNoise& sensor, const ExposureKey& key, const Window& window,
               const Window& plane, GrayImage& image);

  LensMap lens_;
  Pose wMc_;
  ColourImage drawn_;
  std::vector<float> grey_;  // of drawn_
  std::vector<float> scratch_;
  std::vector<LensMap::Sample> samples_;
  std::vector<float> light_;
};

}  // namespace ringhook
