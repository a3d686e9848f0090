#include "camera/stamp_clock.h"

#include <algorithm>

namespace ringhook {
namespace {

constexpr std::int64_t kLookBack_ns = 2'000'000'000;

}  // namespace

Time StampClock::hostTime(std::int64_t stamp_ns, Time arrival) {
  if (!least_.empty() && stamp_ns < least_.back().stamp_ns) {
    least_.clear();  // the camera's clock was set back
  }
  const std::int64_t difference_ns = arrival.nanoseconds() - stamp_ns;
  // Least of a sliding window: an entry behind a smaller one will never be the least again.
  while (!least_.empty() && least_.back().difference_ns >= difference_ns) {
    least_.pop_back();
  }
  least_.push_back({stamp_ns, difference_ns});
  while (least_.front().stamp_ns < stamp_ns - kLookBack_ns) {
    least_.pop_front();
  }
  Time time = Time::fromNanoseconds(stamp_ns + least_.front().difference_ns);
  if (any_) {
    time = std::max(time, last_);
  }
  any_ = true;
  last_ = time;
  lateness_s_ = arrival - time;
  return time;
}

}  // namespace ringhook
