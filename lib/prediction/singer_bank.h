#pragma once

/// \file
/// How a pivot that is seen itself moves, learnt from its own track: its acceleration's standard
/// deviation and memory in Singer's law (IEEE Trans. AES-6, 1970),
///   p' = v, v' = A, A' = -A / memory + e,
/// and how well its samples are timed: a stamp that is off by dt puts the pivot off by v dt. A bank
/// of linear Kalman filters, one for each choice of a grid, goes along with the track; the choice
/// that made the innovations likeliest is believed (Magill, "Optimal adaptive estimation of sampled
/// stochastic processes", IEEE Trans. AC-10, 1965), those of long ago counting less.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/time.h"
#include "prediction/linear_kalman.h"

namespace ringhook {

struct SingerLaw {
  double memory_s = 0.3;                            ///< of the acceleration
  double time_sigma_s = 0.0;                        ///< of the samples' times
  Eigen::Vector3d sigma = Eigen::Vector3d::Ones();  ///< of the acceleration, per axis [m/s^2]
};

class SingerBank {
 public:
  /// `sample_sigma`: measurement noise of each coordinate [m], > 0.
  explicit SingerBank(double sample_sigma);

  /// Takes the pivot [m] at a time later than the last.
  void update(Time time, const Eigen::Vector3d& pivot);

  /// The likeliest so far; nothing before a second was seen.
  [[nodiscard]] std::optional<SingerLaw> likeliest() const;

 private:
  /// One standard deviation of the acceleration.
  struct Member {
    double sigma = 0.0;
    std::array<Gaussian<3>, 3> belief;                 ///< (p, v, A) per axis
    Eigen::Vector3d misfit = Eigen::Vector3d::Zero();  ///< -2 ln likelihood per axis
  };
  /// All of one memory and time noise.
  struct Group {
    double memory_s = 0.0;
    double time_sigma_s = 0.0;
    std::vector<Member> members;
  };
  void begin(const Eigen::Vector3d& pivot);
  void step(Group& group, double dt, const Eigen::Vector3d& pivot);

  double sample_sigma_;
  std::vector<Group> groups_;
  std::optional<Time> time_;
  Time begin_;
};

}  // namespace ringhook
