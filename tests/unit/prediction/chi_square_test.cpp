#include "prediction/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ringhook {
namespace {

// Abramowitz and Stegun, table 26.8.
TEST(ChiSquare, GivesThePrintedQuantiles) {
  EXPECT_NEAR(chiSquareQuantile(0.95, 1.0), 3.841459, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.99, 3.0), 11.344867, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.025, 6.0), 1.237344, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.999, 6.0), 22.457744, 1e-6);
}

TEST(ChiSquare, AgreesWithTheClosedFormOfTwoAndSixDegrees) {
  for (double x = 0.1; x < 60.0; x *= 1.7) {
    EXPECT_NEAR(chiSquareCdf(x, 2.0), 1.0 - std::exp(-x / 2), 1e-13);
    EXPECT_NEAR(chiSquareCdf(x, 6.0), 1.0 - std::exp(-x / 2) * (1 + x / 2 + x * x / 8), 1e-13);
  }
}

TEST(ChiSquare, ServesTheManyDegreesOfLongAverages) {
  // Wilson and Hilferty 1931: (x/k)^(1/3) is nearly normal with mean 1 - 2/(9k).
  const double k = 6000.0;
  const double expected = k * std::pow(1 - 2 / (9 * k) + 1.959964 * std::sqrt(2 / (9 * k)), 3);
  EXPECT_NEAR(chiSquareQuantile(0.975, k), expected, 0.01);
  EXPECT_EQ(chiSquareCdf(-1.0, 3.0), 0.0);
}

}  // namespace
}  // namespace ringhook
