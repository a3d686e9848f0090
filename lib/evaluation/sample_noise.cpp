#include "evaluation/sample_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ringhook {
namespace {

constexpr double kNormalMedian = 0.67448975;  // of |z|, z standard normal

double medianSize(std::vector<double> values) {
  for (double& value : values) {
    value = std::abs(value);
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> differences(const std::vector<double>& values) {
  std::vector<double> between;
  for (std::size_t i = 1; i < values.size(); ++i) {
    between.push_back(values[i] - values[i - 1]);
  }
  return between;
}

/// Rounding to steps of q has the standard deviation q / sqrt(12); q is the least step seen.
double roundingNoise(const std::vector<double>& steps) {
  double least = std::numeric_limits<double>::infinity();
  for (const double step : steps) {
    if (std::abs(step) > 1e-12) {
      least = std::min(least, std::abs(step));
    }
  }
  return std::isfinite(least) ? least / std::sqrt(12.0) : 0.0;
}

double noiseOf(std::vector<double> values) {
  double least = std::numeric_limits<double>::infinity();
  values = differences(values);
  const double rounding = roundingNoise(values);
  double binomial = 2.0;  // of (2k, k)
  for (int k = 2; k <= 6 && values.size() > 1; ++k) {
    values = differences(values);
    binomial *= 2.0 * (2.0 * k - 1.0) / k;
    least = std::min(least, medianSize(values) / kNormalMedian / std::sqrt(binomial));
  }
  return std::isfinite(least) && least > 0.0 ? least : rounding;
}

}  // namespace

double estimateSampleNoise(const Trajectory& trajectory) {
  constexpr double kLeast = 1e-9;
  double sum = 0.0;
  const Eigen::Index size = trajectory.values.front().size();
  for (Eigen::Index i = 0; i < size; ++i) {
    std::vector<double> numbers;
    for (const auto& value : trajectory.values) {
      numbers.push_back(value(i));
    }
    const double sigma = noiseOf(numbers);
    sum += sigma * sigma;
  }
  return std::max(kLeast, std::sqrt(sum / static_cast<double>(size)));
}

}  // namespace ringhook
