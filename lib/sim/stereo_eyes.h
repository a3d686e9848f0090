#pragma once

/// \file
/// Both simulated cameras of a rig: one exposure of the world, in two steps. Capturing takes from
/// the world what the exposure will show, in less than a millisecond, on the thread that moves the
/// world; developing draws it, in tens of milliseconds, and does not look at the world any more. In
/// virtual time one follows the other; a world in real time goes on while its picture is drawn.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/image.h"
#include "core/time.h"
#include "rig/stereo_rig.h"
#include "sim/renderer.h"
#include "sim/sensor_noise.h"

namespace ringhook {

class CellWorld;

/// What an exposure will show.
struct CapturedExposure {
  Time time;                                  ///< mid-exposure
  std::vector<double> weights;                ///< of the instants within the exposure
  std::vector<std::vector<Solid>> solids;     ///< at each of them
  std::array<std::vector<Window>, 2> moving;  ///< parts of both image planes that change
};

class StereoEyes {
 public:
  /// \param true_rig where the cameras truly stand; needs both cameras and fMc1 (else Error). The
  /// world must outlive the eyes. Throws DeviceError without OpenGL.
  StereoEyes(CellWorld& world, const StereoRig& true_rig, const SensorOptions& sensor);
  ~StereoEyes();

  /// Size of the full image, the same for both cameras: (0, 0, width, height) [px].
  [[nodiscard]] const Window& fullImage() const;
  [[nodiscard]] const SensorOptions& sensor() const;
  /// For the exposures captured from now on.
  void setSensor(const SensorOptions& sensor);

  /// An exposure around the world's present instant.
  [[nodiscard]] CapturedExposure capture();
  /// Pixels of `windows`, which lie in the full image; of an empty one nothing. Pixels depend on
  /// the exposure, the world's seed, `frame` and their own place, never on the window.
  [[nodiscard]] std::array<GrayImage, 2> develop(const CapturedExposure& exposure,
                                                 const std::array<Window, 2>& windows,
                                                 std::uint64_t frame);

  /// The world's present instant in colour from any viewpoint, for looking at.
  /// \param plane in pixels about the optical axis.
  void draw(const Pinhole& eye, const Window& plane, ColourImage& image);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ringhook
