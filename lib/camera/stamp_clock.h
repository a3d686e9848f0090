#pragma once

/// \file
/// From a camera's own clock to the host's. A camera that follows the host's time (IEEE 1588, PTP)
/// needs no more than a change of epoch. A free clock is tied to the host's by its earliest
/// arrivals: an image is only ever late, so the least of (arrival - stamp) over the last seconds is
/// the clocks' difference plus the shortest transport, a constant that calibration finds like every
/// other delay. Crystals differ by up to 100 ppm, 0.2 ms in the two seconds looked back.

#include <cstdint>
#include <deque>

#include "core/time.h"

namespace ringhook {

class StampClock {
 public:
  /// Host instant of `stamp_ns` [ns, camera's clock], for an image that began to arrive at
  /// `arrival`. Monotonic: never earlier than an instant given before.
  Time hostTime(std::int64_t stamp_ns, Time arrival);

  /// From the instant so found to the arrival, of the last image [s].
  [[nodiscard]] double lateness() const { return lateness_s_; }

 private:
  struct Arrival {
    std::int64_t stamp_ns = 0;
    std::int64_t difference_ns = 0;  ///< arrival - stamp
  };

  std::deque<Arrival> least_;  ///< differences grow from front to back; the front is the least
  Time last_;
  bool any_ = false;
  double lateness_s_ = 0.0;
};

}  // namespace ringhook
