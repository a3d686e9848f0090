#pragma once

/// \file
/// The one interface of every stereo camera: simulated, replayed from a stored sequence, or real.
/// The camera reads out one window (AOI) per side; a window asked for acts from one of the next
/// exposures on, and every frame says which windows it was taken with.

#include <optional>

#include "core/image.h"
#include "core/stereo_frame.h"

namespace ringhook {

class StereoCamera {
 public:
  StereoCamera() = default;
  StereoCamera(const StereoCamera&) = delete;
  StereoCamera& operator=(const StereoCamera&) = delete;
  virtual ~StereoCamera() = default;

  /// Size of the full image: (0, 0, width, height) [px], the same for both sides.
  [[nodiscard]] virtual Window fullImage() const = 0;

  /// Regions to read from now on; clipped to the full image, an empty one means the full image. A
  /// real camera takes some exposures to follow and may read somewhat more, which holds the window.
  /// A source that cannot choose (a recording) delivers what it has.
  virtual void setWindows(const Window& left, const Window& right) = 0;

  /// Pairs per second [Hz] from now on, up to what the sensor can do; throws DeviceError for a
  /// rate that is not positive. A recording keeps its own rate.
  virtual void setFrameRate(double rate_hz) = 0;

  /// The next pair that has arrived, oldest first; nothing if none came within `timeout_s` [s].
  /// In virtual time and for recordings the timeout is not waited for. Frames come in order of
  /// time. Throws DeviceError when the device is lost, InputError for an unreadable file.
  [[nodiscard]] virtual std::optional<StereoFrame> grab(double timeout_s) = 0;

  /// True once no further frame will come (end of a recording).
  [[nodiscard]] virtual bool finished() const = 0;
};

}  // namespace ringhook
