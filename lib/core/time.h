#pragma once

/// \file
/// An instant on the cell's clock. Time enters with data only: stamps mean mid-exposure or
/// sampling instant, never arrival, so this type has no now(). Only device and app code reads
/// clocks. Durations are plain doubles in seconds.

#include <cmath>
#include <compare>
#include <cstdint>

namespace ringhook {

class Time {
 public:
  constexpr Time() = default;

  /// \param seconds since the clock's epoch [s]; rounded to the nearest nanosecond.
  static Time fromSeconds(double seconds) {
    return Time(static_cast<std::int64_t>(std::llround(seconds * 1e9)));
  }
  static constexpr Time fromNanoseconds(std::int64_t nanoseconds) { return Time(nanoseconds); }

  [[nodiscard]] constexpr double seconds() const { return static_cast<double>(ns_) * 1e-9; }
  [[nodiscard]] constexpr std::int64_t nanoseconds() const { return ns_; }

  constexpr auto operator<=>(const Time&) const = default;

 private:
  explicit constexpr Time(std::int64_t nanoseconds) : ns_(nanoseconds) {}
  std::int64_t ns_ = 0;  ///< since the clock's epoch [ns]
};

/// The instant `seconds` [s] later (earlier when negative).
inline Time operator+(Time t, double seconds) {
  return Time::fromNanoseconds(t.nanoseconds() +
                               static_cast<std::int64_t>(std::llround(seconds * 1e9)));
}
inline Time operator-(Time t, double seconds) { return t + (-seconds); }

/// Seconds from b to a [s].
inline double operator-(Time a, Time b) {
  return static_cast<double>(a.nanoseconds() - b.nanoseconds()) * 1e-9;
}

}  // namespace ringhook
