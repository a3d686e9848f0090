#include "cycle/vision_step.h"

#include <gtest/gtest.h>

namespace ringhook {
namespace {

TEST(ExpectedInterval, IsThePeriodWhileNothingElseIsKnown) {
  EXPECT_DOUBLE_EQ(expectedInterval(std::nullopt, 50.0), 0.02);
  EXPECT_DOUBLE_EQ(expectedInterval(std::nullopt, 2.0), 0.5);
}

TEST(ExpectedInterval, OfACameraThatCannotKeepUpIsItsLastOne) {
  EXPECT_DOUBLE_EQ(expectedInterval(0.08, 50.0), 0.08);
}

TEST(ExpectedInterval, IsNeverShorterThanThePeriod) {
  EXPECT_DOUBLE_EQ(expectedInterval(0.001, 50.0), 0.02);
}

TEST(ExpectedInterval, AfterAGapDoesNotLookFartherThanTheWindowsCanFollow) {
  EXPECT_DOUBLE_EQ(expectedInterval(3.0, 50.0), 0.2);
}

}  // namespace
}  // namespace ringhook
