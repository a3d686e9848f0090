#include "core/outcome.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ringhook {
namespace {

Outcome<double> root(double x) {
  if (x < 0) {
    return Refusal{"negative"};
  }
  return std::sqrt(x);
}

TEST(Outcome, HoldsAValueOrTheReasonWhyNot) {
  const Outcome<double> good = root(4.0);
  ASSERT_TRUE(good);
  EXPECT_DOUBLE_EQ(*good, 2.0);
  const Outcome<double> bad = root(-1.0);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.reason(), "negative");
}

}  // namespace
}  // namespace ringhook
