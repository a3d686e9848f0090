#pragma once

/// \file
/// Kalman filters of coordinates that obey one law and do not know of each other, as x and y of a
/// swing: transition and noise are made once a step and used for every axis. Filters after
/// linear_kalman.h, no gate: these are the models that ours is compared with.

#include <Eigen/Core>
#include <array>
#include <cassert>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/time.h"
#include "prediction/linear_kalman.h"

namespace ringhook {

/// What happens to one axis in a while.
template <int N>
struct AxisStep {
  Eigen::Matrix<double, N, N> transition;  ///< A
  Eigen::Matrix<double, N, N> noise;       ///< Q
};

/// State of N numbers, measurement of M; units as the state defines them.
template <int N, int M>
struct AxisLaw {
  std::function<AxisStep<N>(double)> step;  ///< over dt >= 0 [s]; pure
  Eigen::Matrix<double, M, N> measured;     ///< C: what is measured of a state
  Eigen::Matrix<double, 1, N> wanted;       ///< what a prediction is about
  Eigen::Matrix<double, N, 1> prior_sigma;  ///< of a state before the first sample, mean 0
  double sample_sigma = 0.0;                ///< of each measured number, > 0
};

/// Where the numbers of one axis stand.
template <int M>
struct AxisPlace {
  std::array<int, M> measured;  ///< in a sample
  int predicted = 0;            ///< in a prediction
};

/// Axes of one law, whatever its size.
class AxisGroup {
 public:
  AxisGroup() = default;
  virtual ~AxisGroup() = default;
  AxisGroup(const AxisGroup&) = delete;
  AxisGroup& operator=(const AxisGroup&) = delete;

  /// Takes a sample later than the last one. The first has no innovation: 0 degrees.
  virtual FilterUpdate update(Time time, const Eigen::VectorXd& value) = 0;

  /// Writes its entries of the belief. Precondition: updated once, `time` not before that.
  virtual void predict(Time time, Gaussian<Eigen::Dynamic>& belief) const = 0;
};

template <int N, int M>
class AxisFilters final : public AxisGroup {
 public:
  AxisFilters(AxisLaw<N, M> law, std::vector<AxisPlace<M>> places)
      : law_(std::move(law)), places_(std::move(places)) {
    const Eigen::Matrix<double, N, 1> variance = law_.prior_sigma.cwiseAbs2();
    beliefs_.assign(places_.size(), {Eigen::Matrix<double, N, 1>::Zero(), variance.asDiagonal()});
  }

  FilterUpdate update(Time time, const Eigen::VectorXd& value) override {
    const bool first = !time_;
    FilterUpdate done{time, 0.0, 0};
    for (std::size_t i = 0; i < places_.size(); ++i) {
      Eigen::Matrix<double, M, 1> y;
      for (int j = 0; j < M; ++j) {
        y(j) = value(places_[i].measured[static_cast<std::size_t>(j)]);
      }
      const Eigen::Matrix<double, M, M> R =
          law_.sample_sigma * law_.sample_sigma * Eigen::Matrix<double, M, M>::Identity();
      const Gaussian<N> prior = first ? beliefs_[i] : ahead(i, time);
      const Correction<N, M> correction = kalmanCorrect<N, M>(prior, y, law_.measured, R);
      beliefs_[i] = correction.belief;
      done.nis += first ? 0.0 : correction.nis;
      done.degrees += first ? 0 : M;
    }
    time_ = time;
    return done;
  }

  void predict(Time time, Gaussian<Eigen::Dynamic>& belief) const override {
    assert(time_ && time >= *time_);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Gaussian<N> then = ahead(i, time);
      const int at = places_[i].predicted;
      belief.mean(at) = law_.wanted.dot(then.mean);
      belief.covariance(at, at) = carried(law_.wanted, then.covariance)(0, 0);
    }
  }

 private:
  [[nodiscard]] Gaussian<N> ahead(std::size_t axis, Time time) const {
    const AxisStep<N>& step = stepOf(time);
    return kalmanPredict<N>(beliefs_[axis], step.transition, step.noise);
  }

  /// Steps repeat: frames and horizons are few.
  const AxisStep<N>& stepOf(Time time) const {
    constexpr std::size_t kKept = 64;
    const std::int64_t key = time.nanoseconds() - time_->nanoseconds();
    const auto found = steps_.find(key);
    if (found != steps_.end()) {
      return found->second;
    }
    if (steps_.size() >= kKept) {
      steps_.clear();
    }
    return steps_.emplace(key, law_.step(time - *time_)).first->second;
  }

  AxisLaw<N, M> law_;
  std::vector<AxisPlace<M>> places_;
  std::vector<Gaussian<N>> beliefs_;  ///< of the axes, at time_
  std::optional<Time> time_;
  mutable std::map<std::int64_t, AxisStep<N>> steps_;  ///< by duration [ns]
};

}  // namespace ringhook
