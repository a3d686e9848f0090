#pragma once

/// \file
/// When a feedback was sampled. The controller samples every 4 ms, but its time field is not usable
/// (messages.h) and the moment a message is read jitters with network and scheduler. Delays only
/// ever make a message late, so the sampling grid is followed by a second-order lock that trusts
/// early arrivals more than late ones; what remains is a constant transport delay, found by
/// calibration like every other delay.

#include <cstdint>

#include "core/time.h"

namespace ringhook::rx60 {

/// How regularly feedbacks arrive. Times of the host.
struct ArrivalStatistics {
  std::int64_t feedbacks = 0;
  std::int64_t missed_cycles = 0;  ///< grid points without an arrival of their own
  double period_s = 0.0;           ///< of the grid, as locked [s]
  double jitter_s = 0.0;           ///< RMS of arrival against the grid, of the last second or so
  double worst_gap_s = 0.0;        ///< longest time between two arrivals since the start [s]
};

class FeedbackClock {
 public:
  explicit FeedbackClock(double period_s) : nominal_s_(period_s), period_s_(period_s) {}

  /// The sampling instant of the feedback that was read at `arrival`, up to a constant delay.
  /// Strictly later than the one before.
  Time stamp(Time arrival);

  [[nodiscard]] ArrivalStatistics statistics() const;

 private:
  double nominal_s_;
  double period_s_;
  Time last_stamp_;
  Time last_arrival_;
  double mean_square_s2_ = 0.0;  ///< of arrival against grid, forgetting
  double worst_gap_s_ = 0.0;
  std::int64_t feedbacks_ = 0;
  std::int64_t missed_ = 0;
};

}  // namespace ringhook::rx60
