#pragma once

/// \file
/// When a camera was being restarted. A region of another size takes a restart of each camera, one
/// after the other: what one of them exposes meanwhile has no partner, and that is no loss. Written
/// by the thread that restarts, read by the one that pairs images.

#include <algorithm>
#include <deque>
#include <limits>
#include <mutex>

#include "core/time.h"

namespace ringhook {

class RestartSpans {
 public:
  /// From this exposure on; until end() the span is open.
  void begin(Time from) {
    const std::lock_guard lock(mutex_);
    spans_.push_back({from, Time::fromNanoseconds(std::numeric_limits<std::int64_t>::max())});
    if (spans_.size() > kRemembered) {
      spans_.pop_front();
    }
  }
  /// Both cameras stream again.
  void end(Time until) {
    const std::lock_guard lock(mutex_);
    if (!spans_.empty()) {
      spans_.back().until = until;
    }
  }
  [[nodiscard]] bool covers(Time exposure) const {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(spans_, [exposure](const Span& span) {
      return span.from <= exposure && exposure < span.until;
    });
  }

 private:
  struct Span {
    Time from;
    Time until;
  };
  static constexpr std::size_t kRemembered = 16;  // an image waits through one or two at most

  mutable std::mutex mutex_;
  std::deque<Span> spans_;
};

}  // namespace ringhook
