#include "robot/rx60/feedback_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ringhook::rx60 {
namespace {

/// RMS of stamps against the true sampling grid after the lock has settled, the constant part taken
/// out [s].
double stampError(double period_s, double mean_delay_s, std::uint32_t seed) {
  FeedbackClock clock(0.004);
  std::mt19937 random(seed);
  std::exponential_distribution<double> delay(1.0 / mean_delay_s);
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  Time before;
  for (int k = 0; k < 5000; ++k) {
    const Time sampled = Time::fromSeconds(10.0 + k * period_s);
    const Time arrival = std::max(before, sampled + 0.0003 + delay(random));
    before = arrival;
    const double error = clock.stamp(arrival) - sampled;
    if (k >= 2500) {
      sum += error;
      squares += error * error;
      ++count;
    }
  }
  const double mean = sum / count;
  return std::sqrt(squares / count - mean * mean);
}

TEST(FeedbackClock, ReturnsToTheSamplingGrid) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    EXPECT_LT(stampError(0.004, 0.0002, seed), 0.00005) << "delays alone scatter by 0.2 ms";
    EXPECT_LT(stampError(0.0040002, 0.0002, seed), 0.00005) << "a quartz 50 ppm off";
  }
}

TEST(FeedbackClock, NeverStampsMuchLaterThanTheArrivalNorGoesBack) {
  FeedbackClock clock(0.004);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> step(0.0, 0.012);
  Time arrival = Time::fromSeconds(1.0);
  Time last = clock.stamp(arrival);
  for (int k = 0; k < 2000; ++k) {
    arrival = arrival + step(random);
    const Time stamp = clock.stamp(arrival);
    EXPECT_GT(stamp, last);
    EXPECT_LE(stamp - arrival, 0.51 * 0.004) << "half a period";
    last = stamp;
  }
}

TEST(FeedbackClock, CountsTheGridPointsWithoutAnArrival) {
  FeedbackClock clock(0.004);
  for (const int k : {0, 1, 2, 5, 6, 10, 11}) {
    static_cast<void>(clock.stamp(Time::fromSeconds(2.0 + k * 0.004)));
  }
  EXPECT_EQ(clock.statistics().feedbacks, 7);
  EXPECT_EQ(clock.statistics().missed_cycles, 5);
  EXPECT_NEAR(clock.statistics().worst_gap_s, 0.016, 1e-9);
}

}  // namespace
}  // namespace ringhook::rx60
