#include "robot/rx60/feedback_clock.h"

#include <algorithm>
#include <cmath>

namespace ringhook::rx60 {
namespace {

constexpr double kEarlyGain = 0.05;    // of the phase, for an arrival before the grid
constexpr double kLateGain = 0.005;    // and behind it
constexpr double kPeriodGain = 1e-4;   // of the period
constexpr double kPeriodRange = 0.02;  // the controller's quartz is far better than that
constexpr double kForget = 1.0 / 250.0;
constexpr double kLeastStep = 1e-6;  // [s]

}  // namespace

Time FeedbackClock::stamp(Time arrival) {
  if (feedbacks_++ == 0) {
    last_stamp_ = last_arrival_ = arrival;
    return arrival;
  }
  const double gap = arrival - last_arrival_;
  worst_gap_s_ = std::max(worst_gap_s_, gap);
  last_arrival_ = arrival;
  missed_ += std::max<std::int64_t>(0, std::llround(gap / period_s_) - 1);
  // One grid point further, or several where messages are missing.
  const double behind = arrival - (last_stamp_ + period_s_);
  const Time predicted =
      last_stamp_ + (1.0 + std::max(0.0, std::round(behind / period_s_))) * period_s_;
  const double error = arrival - predicted;
  mean_square_s2_ += kForget * (error * error - mean_square_s2_);
  period_s_ = std::clamp(period_s_ + kPeriodGain * std::clamp(error, -nominal_s_, nominal_s_),
                         (1.0 - kPeriodRange) * nominal_s_, (1.0 + kPeriodRange) * nominal_s_);
  // Far ahead of an arrival: the messages of a burst, which follow one another at once.
  const bool burst = error < -0.5 * period_s_;
  const double gain = burst ? 1.0 : (error < 0.0 ? kEarlyGain : kLateGain);
  last_stamp_ = std::max(predicted + gain * error, last_stamp_ + kLeastStep);
  return last_stamp_;
}

ArrivalStatistics FeedbackClock::statistics() const {
  return {feedbacks_, missed_, period_s_, std::sqrt(mean_square_s2_), worst_gap_s_};
}

}  // namespace ringhook::rx60
