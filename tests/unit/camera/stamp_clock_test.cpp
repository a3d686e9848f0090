#include "camera/stamp_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ringhook {
namespace {

constexpr std::int64_t kEpoch_ns = 5'000'000'000'000;  // the camera was switched on long ago
constexpr double kShortest_s = 0.0012;                 // transport

/// An image exposed at host time `time_s`, as a camera with a clock `drift` too fast tells it.
std::int64_t stampOf(double time_s, double drift) {
  return kEpoch_ns + static_cast<std::int64_t>(time_s * (1.0 + drift) * 1e9);
}

TEST(StampClock, FindsTheHostsTimeUpToTheShortestTransport) {
  std::mt19937 random(1);
  std::exponential_distribution<double> late(1.0 / 0.004);
  for (const double drift : {0.0, 50e-6, -50e-6}) {
    StampClock clock;
    double worst_s = 0.0;
    for (int i = 0; i < 3000; ++i) {
      const double exposed_s = 100.0 + 0.02 * i;
      const Time arrival = Time::fromSeconds(exposed_s + kShortest_s + late(random));
      const Time found = clock.hostTime(stampOf(exposed_s, drift), arrival);
      EXPECT_GE(clock.lateness(), 0.0);
      if (i > 100) {
        worst_s = std::max(worst_s, std::abs(found.seconds() - exposed_s - kShortest_s));
      }
    }
    // 50 ppm over the two seconds looked back, and the least of 100 exponential delays.
    EXPECT_LT(worst_s, 0.0001 + 0.0005) << drift;
  }
}

TEST(StampClock, TimesNeverGoBack) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> late(0.0, 0.05);
  StampClock clock;
  Time last;
  for (int i = 0; i < 1000; ++i) {
    const double exposed_s = 0.002 * i;
    const Time found = clock.hostTime(stampOf(exposed_s, 0.0),
                                      Time::fromSeconds(exposed_s + kShortest_s + late(random)));
    EXPECT_GE(found, last);
    last = found;
  }
}

TEST(StampClock, StartsAnewWhenTheCamerasClockIsSetBack) {
  StampClock clock;
  static_cast<void>(clock.hostTime(kEpoch_ns, Time::fromSeconds(10.0)));
  const Time found = clock.hostTime(20'000'000, Time::fromSeconds(11.0));
  EXPECT_EQ(found, Time::fromSeconds(11.0));
}

}  // namespace
}  // namespace ringhook
