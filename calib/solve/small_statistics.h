#pragma once

/// \file
/// Figures that several calibrations need.

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

namespace ringhook {

/// The middle value, or the mean of the two middle ones. Precondition: at least one value.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) {
    return *middle;
  }
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// Whether the mean of values is above zero by more than two standard errors: what is asked before
/// another model is believed for what it predicts. Precondition: at least two values.
inline bool clearlyPositive(const std::vector<double>& values) {
  const Eigen::Map<const Eigen::ArrayXd> v(values.data(), static_cast<Eigen::Index>(values.size()));
  const auto n = static_cast<double>(v.size());
  const double variance = (v - v.mean()).square().sum() / (n - 1.0);
  return v.mean() > 2.0 * std::sqrt(variance / n);
}

/// Standard deviation in the direction in which it is largest; unit of the covariance's root.
inline double largestSigma(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[2]));
}

}  // namespace ringhook
