#include "cycle/statistics.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace ringhook {
namespace {

std::vector<double> seededValues(std::size_t count, double offset) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(offset, 2.0);
  std::vector<double> values(count);
  for (double& value : values) {
    value = normal(random);
  }
  return values;
}

Statistics of(const std::vector<double>& values) {
  Statistics statistics;
  for (const double value : values) {
    statistics.add(value);
  }
  return statistics;
}

void expectSame(const Statistics& a, const Statistics& b) {
  EXPECT_EQ(a.count(), b.count());
  EXPECT_NEAR(a.mean(), b.mean(), 1e-12);
  EXPECT_NEAR(a.std(), b.std(), 1e-12);
  EXPECT_NEAR(a.rms(), b.rms(), 1e-12);
  EXPECT_DOUBLE_EQ(a.max(), b.max());
}

TEST(Statistics, AgreesWithTheTextbookSums) {
  const std::vector<double> values = seededValues(501, -3.0);
  const double n = 501.0;
  double sum = 0.0;
  double squares = 0.0;
  double greatest = values.front();
  for (const double v : values) {
    sum += v;
    squares += v * v;
    greatest = v > greatest ? v : greatest;
  }
  const double mean = sum / n;
  double deviations = 0.0;
  for (const double v : values) {
    deviations += (v - mean) * (v - mean);
  }
  const Statistics statistics = of(values);
  EXPECT_EQ(statistics.count(), 501U);
  EXPECT_NEAR(statistics.mean(), mean, 1e-12);
  EXPECT_NEAR(statistics.std(), std::sqrt(deviations / (n - 1.0)), 1e-12);
  EXPECT_NEAR(statistics.rms(), std::sqrt(squares / n), 1e-12);
  EXPECT_DOUBLE_EQ(statistics.max(), greatest);
}

TEST(Statistics, KeepsSmallSpreadOnALargeOffset) {
  // The sum of squares would lose all digits of a spread of 1 on an offset of 1e9.
  const Statistics statistics = of({1e9 - 1.0, 1e9, 1e9 + 1.0});
  EXPECT_NEAR(statistics.std(), 1.0, 1e-6);
}

TEST(Statistics, GreatestOfNegativeValuesIsNegative) {
  EXPECT_DOUBLE_EQ(of({-5.0, -2.0, -9.0}).max(), -2.0);
}

TEST(Statistics, EmptyIsZeroAndOneValueHasNoSpread) {
  EXPECT_EQ(Statistics().count(), 0U);
  EXPECT_EQ(Statistics().mean(), 0.0);
  EXPECT_EQ(Statistics().rms(), 0.0);
  EXPECT_EQ(of({4.0}).std(), 0.0);
  EXPECT_DOUBLE_EQ(of({4.0}).rms(), 4.0);
}

TEST(Statistics, MergeEqualsAddingAll) {
  const std::vector<double> all = seededValues(300, 5.0);
  for (const std::ptrdiff_t split : {0, 1, 40, 299, 300}) {
    Statistics merged = of({all.begin(), all.begin() + split});
    merged.merge(of({all.begin() + split, all.end()}));
    expectSame(merged, of(all));
  }
}

}  // namespace
}  // namespace ringhook
