#include "prediction/singer_bank.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "prediction/van_loan.h"

namespace ringhook {
namespace {

constexpr double kMemories[] = {0.1, 0.3, 1.0, 3.0};                              // [s]
constexpr double kSigmas[] = {1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 3.0, 10.0};  // [m/s^2]
constexpr double kJitters[] = {0.0, 1e-3, 3e-3, 1e-2};                            // [s]
constexpr double kFast = 20.0;      // [m/s]; before the first sample
constexpr double kForget = 30.0;    // [s]
constexpr double kFirstLook = 1.0;  // [s]

std::vector<std::pair<double, double>> choices() {
  std::vector<std::pair<double, double>> all;
  for (const double memory : kMemories) {
    for (const double jitter : kJitters) {
      all.emplace_back(memory, jitter);
    }
  }
  return all;
}

/// Singer's law of unit standard deviation over dt.
SampledLaw singerStep(double memory_s, double dt) {
  Eigen::Matrix3d drift = Eigen::Matrix3d::Zero();
  drift(0, 1) = drift(1, 2) = 1.0;
  drift(2, 2) = -1.0 / memory_s;
  Eigen::Matrix3d density = Eigen::Matrix3d::Zero();
  density(2, 2) = 2.0 / memory_s;
  return sampleLaw(drift, density, dt);
}

}  // namespace

SingerBank::SingerBank(double sample_sigma) : sample_sigma_(sample_sigma) {
  assert(sample_sigma > 0.0);
}

void SingerBank::update(Time time, const Eigen::Vector3d& pivot) {
  if (!time_) {
    begin_ = time;
    begin(pivot);
  } else {
    for (Group& group : groups_) {
      step(group, time - *time_, pivot);
    }
  }
  time_ = time;
}

void SingerBank::begin(const Eigen::Vector3d& pivot) {
  for (const auto& [memory, jitter] : choices()) {
    Group group{memory, jitter, {}};
    for (const double sigma : kSigmas) {
      const Eigen::Vector3d deviation(sample_sigma_, kFast, sigma);
      const Eigen::Matrix3d P = deviation.cwiseAbs2().asDiagonal();
      const auto at = [&](int axis) {
        return Gaussian<3>{Eigen::Vector3d(pivot(axis), 0.0, 0.0), P};
      };
      group.members.push_back({sigma, {at(0), at(1), at(2)}, Eigen::Vector3d::Zero()});
    }
    groups_.push_back(group);
  }
}

void SingerBank::step(Group& group, double dt, const Eigen::Vector3d& pivot) {
  const SampledLaw law = singerStep(group.memory_s, dt);
  const Eigen::Matrix3d A = law.transition;
  const Eigen::Matrix3d Q = law.noise;
  const Eigen::RowVector3d C(1.0, 0.0, 0.0);
  for (Member& member : group.members) {
    for (int axis = 0; axis < 3; ++axis) {
      const Gaussian<3> ahead =
          kalmanPredict<3>(member.belief[axis], A, member.sigma * member.sigma * Q);
      const Eigen::Matrix<double, 1, 1> y(pivot(axis));
      const double late = group.time_sigma_s * ahead.mean(1);
      const Eigen::Matrix<double, 1, 1> R(sample_sigma_ * sample_sigma_ + late * late);
      const auto correction = kalmanCorrect<3, 1>(ahead, y, C, R);
      member.belief[axis] = correction.belief;
      member.misfit(axis) = std::exp(-dt / kForget) * member.misfit(axis) + correction.nis +
                            std::log(correction.innovation_covariance(0, 0));
    }
  }
}

std::optional<SingerLaw> SingerBank::likeliest() const {
  if (!time_ || *time_ - begin_ < kFirstLook) {
    return std::nullopt;
  }
  std::optional<SingerLaw> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Group& group : groups_) {
    SingerLaw law{group.memory_s, group.time_sigma_s, Eigen::Vector3d::Zero()};
    double misfit = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto member = std::ranges::min_element(
          group.members, {}, [axis](const Member& one) { return one.misfit(axis); });
      law.sigma(axis) = member->sigma;
      misfit += member->misfit(axis);
    }
    if (misfit < least) {
      least = misfit;
      best = law;
    }
  }
  return best;
}

}  // namespace ringhook
