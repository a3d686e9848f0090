#include "core/number_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ringhook {
namespace {

TEST(NumberText, ReadsBackAsTheSameBits) {
  double value = 1.0;
  for (int i = 0; i < 1000; ++i) {
    value = std::sin(1e5 * value + i) * std::pow(10.0, i % 41 - 20);
    EXPECT_EQ(std::stod(exactText(value)), value);
  }
  EXPECT_EQ(exactText(0.1), "0.1");
  EXPECT_EQ(exactText(-2.0), "-2");
}

TEST(NumberText, SecondsKeepEveryNanosecond) {
  EXPECT_EQ(secondsText(Time::fromNanoseconds(1'234'567'890'123'456'789)), "1234567890.123456789");
  EXPECT_EQ(secondsText(Time::fromNanoseconds(-5)), "-0.000000005");
  EXPECT_EQ(secondsText(Time()), "0.000000000");
}

}  // namespace
}  // namespace ringhook
