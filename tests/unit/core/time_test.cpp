#include "core/time.h"

#include <gtest/gtest.h>

namespace ringhook {
namespace {

TEST(Time, KeepsNanosecondsOverYears) {
  const Time year = Time::fromNanoseconds(31'536'000'000'000'000);
  const Time later = year + 1e-9;
  EXPECT_EQ(later.nanoseconds() - year.nanoseconds(), 1);
  EXPECT_DOUBLE_EQ(later - year, 1e-9);
}

TEST(Time, AddsUpExactlyInSteps) {
  Time t;
  for (int i = 0; i < 250'000; ++i) {
    t = t + 0.004;
  }
  EXPECT_EQ(t.nanoseconds(), 1'000'000'000'000);
}

TEST(Time, OrdersAndRoundsToTheNearestNanosecond) {
  EXPECT_LT(Time::fromSeconds(1.0), Time::fromSeconds(1.000000001));
  EXPECT_EQ(Time::fromSeconds(0.1).nanoseconds(), 100'000'000);
  EXPECT_EQ((Time::fromSeconds(1.0) - 0.25).nanoseconds(), 750'000'000);
  EXPECT_DOUBLE_EQ(Time::fromSeconds(2.5).seconds(), 2.5);
}

}  // namespace
}  // namespace ringhook
