#pragma once

/// \file
/// Pictures of a world that goes on in real time. A camera asks on its own thread; the thread that
/// moves the world captures an exposure at its next instant; the camera's thread draws it. The
/// picture is given out no earlier than the transport delay after mid-exposure. While the world
/// stands still (nobody has connected yet) pictures are dark.

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>

#include "sim/shared_trigger.h"
#include "sim/stereo_eyes.h"

namespace ringhook {

class LiveExposures {
 public:
  /// The eyes must outlive this. \param transport_delay_s from mid-exposure to arrival [s].
  LiveExposures(StereoEyes& eyes, double transport_delay_s)
      : eyes_(eyes), sensor_(eyes.sensor()), transport_delay_s_(transport_delay_s) {}

  /// The world's thread, between two of its steps; never waits, and leaves a camera that is just
  /// asking to the next instant. \param real_ns the host's real time at which the world's present
  /// instant is now [ns].
  void worldIsAt(std::int64_t real_ns);

  /// A camera's thread: an exposure and its pictures; nothing once closed.
  [[nodiscard]] std::optional<ExposedPair> expose(const ExposureRequest& request);

  /// Lets a waiting camera go.
  void close();

  [[nodiscard]] std::int64_t pairs() const;

 private:
  struct Capture {
    CapturedExposure exposure;
    std::int64_t mid_ns = 0;  ///< mid-exposure, host's real time [ns]
  };

  [[nodiscard]] std::optional<Capture> capture(double exposure_s);

  StereoEyes& eyes_;
  SensorOptions sensor_;
  double transport_delay_s_;
  mutable std::mutex mutex_;  ///< guards what follows, and capturing
  std::condition_variable captured_;
  std::optional<double> wanted_s_;  ///< exposure that a camera waits for [s]
  std::optional<Capture> taken_;
  bool closed_ = false;
  std::int64_t pairs_ = 0;
};

}  // namespace ringhook
