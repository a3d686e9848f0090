#pragma once

/// \file
/// Running mean, standard deviation, root mean square and greatest of a series (Welford 1962).

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ringhook {

class Statistics {
 public:
  void add(double value) {
    ++count_;
    const double delta = value - mean_;
    mean_ += delta / static_cast<double>(count_);
    squares_ += delta * (value - mean_);
    max_ = count_ == 1 ? value : std::max(max_, value);
  }
  /// As if all values of `other` had been added here (Chan, Golub, LeVeque 1979).
  void merge(const Statistics& other) {
    if (other.count_ == 0) {
      return;
    }
    const auto n = static_cast<double>(count_);
    const auto m = static_cast<double>(other.count_);
    const double delta = other.mean_ - mean_;
    max_ = count_ == 0 ? other.max_ : std::max(max_, other.max_);
    count_ += other.count_;
    mean_ += delta * m / (n + m);
    squares_ += other.squares_ + delta * delta * n * m / (n + m);
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double mean() const { return mean_; }
  [[nodiscard]] double std() const {
    return count_ > 1 ? std::sqrt(squares_ / static_cast<double>(count_ - 1)) : 0.0;
  }
  [[nodiscard]] double rms() const {
    return count_ > 0 ? std::sqrt(mean_ * mean_ + squares_ / static_cast<double>(count_)) : 0.0;
  }
  [[nodiscard]] double max() const { return max_; }

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;  ///< sum of squared deviations from the mean
  double max_ = 0.0;
};

}  // namespace ringhook
