#include "evaluation/noise_experiment.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <random>

#include "prediction/constant_acceleration.h"

namespace ringhook {
namespace {

constexpr int kPositions = 21;
constexpr double kStepLength = 0.02934;  // [m]
constexpr int kFirstJudged = 3;          // before, three samples are not there
constexpr int kSettledOver = 5;          // last positions
constexpr unsigned kSeeds = 300;
constexpr double kSigma = 1e-3;  // [m]; any value, since errors are proportional to it
constexpr int kAxes = 3;

/// Sums over seeds and axes, by position.
struct Tally {
  std::array<double, kPositions> size{};
  std::array<double, kPositions> square{};
  double nis = 0.0;
  int updates = 0;
};

void runSequence(const ConstantAccelerationOptions& options, unsigned seed, Tally& tally) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, kSigma);
  ConstantAccelerationFilter filter(options);
  const Eigen::Matrix3d R = kSigma * kSigma * Eigen::Matrix3d::Identity();
  for (int i = 0; i < kPositions; ++i) {
    const Time time = Time::fromSeconds(i);
    const Eigen::Vector3d truth(0.0, kStepLength * i, 0.0);
    if (const auto ahead = filter.predict(time)) {
      const Eigen::Vector3d error = (ahead->mean.head<3>() - truth) / kSigma;
      tally.size.at(static_cast<std::size_t>(i)) += error.cwiseAbs().sum();
      tally.square.at(static_cast<std::size_t>(i)) += error.squaredNorm();
    }
    const Eigen::Vector3d noise(normal(random), normal(random), normal(random));
    const auto update = filter.update(time, truth + noise, R);
    if (update && i >= kFirstJudged) {
      tally.nis += update->nis;
      tally.updates += update->degrees;
    }
  }
}

NoiseRow rowOf(double ratio, const Tally& tally) {
  constexpr double kCount = kAxes * static_cast<double>(kSeeds);
  NoiseRow row;
  row.ratio = ratio;
  row.nis = tally.nis / tally.updates;
  for (std::size_t i = kFirstJudged; i < kPositions; ++i) {
    row.mean += tally.size.at(i) / kCount / (kPositions - kFirstJudged);
  }
  double settled = 0.0;
  for (std::size_t i = kPositions - kSettledOver; i < kPositions; ++i) {
    settled += tally.square.at(i) / kCount / kSettledOver;
  }
  row.settled_rms = std::sqrt(settled);
  row.settled_after = kPositions;
  const double near = 1.44 * settled;  // 1.2 squared
  while (row.settled_after > 1 &&
         tally.square.at(static_cast<std::size_t>(row.settled_after) - 1) / kCount <= near) {
    --row.settled_after;
  }
  return row;
}

template <class Noise>
std::vector<NoiseRow> sweep(const Noise& noise) {
  std::vector<NoiseRow> rows;
  for (int third = -9; third <= 6; ++third) {
    const double ratio = std::pow(10.0, third / 3.0);
    ConstantAccelerationOptions options = noise(ratio * kSigma);
    options.speed_sigma = 1e3 * kSigma;  // as good as nothing known, as in the closed form
    options.acceleration_sigma = 1e3 * kSigma;
    Tally tally;
    for (unsigned seed = 0; seed < kSeeds; ++seed) {
      runSequence(options, seed, tally);
    }
    rows.push_back(rowOf(ratio, tally));
  }
  return rows;
}

}  // namespace

double parabolaDeviation(int samples) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (int i = 0; i < samples; ++i) {
    const double t = i - samples;  // the predicted position stands at 0
    const Eigen::Vector3d powers(1.0, t, t * t);
    normal += powers * powers.transpose();
  }
  return std::sqrt(normal.inverse()(0, 0));
}

NoiseExperiment runNoiseExperiment() {
  NoiseExperiment experiment;
  experiment.diagonal = sweep([](double sigma) {
    ConstantAccelerationOptions options;
    options.fixed_noise = reportNoise(sigma, sigma, sigma);
    return options;
  });
  experiment.jerk = sweep([](double sigma) {
    ConstantAccelerationOptions options;
    options.jerk_density = sigma * sigma;
    return options;
  });
  return experiment;
}

}  // namespace ringhook
