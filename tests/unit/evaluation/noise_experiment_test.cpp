#include "evaluation/noise_experiment.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace ringhook {
namespace {

const NoiseExperiment& experiment() {
  static const NoiseExperiment once = runNoiseExperiment();
  return once;
}

TEST(ParabolaDeviation, IsRootNineteenOnThreePositionsAndFallsWithMore) {
  EXPECT_NEAR(parabolaDeviation(3), std::sqrt(19.0), 1e-12);
  double last = parabolaDeviation(3);
  for (int samples = 4; samples < 30; ++samples) {
    EXPECT_LT(parabolaDeviation(samples), last);
    last = parabolaDeviation(samples);
  }
}

/// Deviation of one-step predictions of the settled filter on a motion of its own law, in units of
/// the measurement noise: its gain from the Riccati equation, the error it leaves from Lyapunov's.
double settledDeviation(const Eigen::Matrix3d& Q) {
  Eigen::Matrix3d A;
  A << 1.0, 1.0, 0.5, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0;
  Eigen::Matrix3d P = Eigen::Matrix3d::Identity();
  Eigen::Vector3d K;
  for (int i = 0; i < 2000; ++i) {
    K = P.col(0) / (P(0, 0) + 1.0);
    P = A * (P - K * P.row(0)) * A.transpose() + Q;
  }
  Eigen::Matrix3d keep = A;
  keep.col(0) -= A * K;
  const Eigen::Matrix3d input = A * K * K.transpose() * A.transpose();
  Eigen::Matrix3d errors = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 2000; ++i) {
    errors = keep * errors * keep.transpose() + input;
  }
  return std::sqrt(errors(0, 0));
}

// 300 seeds, three axes, five positions: about 2 % of one standard deviation.
TEST(NoiseExperiment, WithoutProcessNoiseEndsWhereLeastSquaresEnds) {
  double all = 0.0;
  for (int samples = 16; samples <= 20; ++samples) {
    all += std::pow(parabolaDeviation(samples), 2) / 5.0;
  }
  EXPECT_NEAR(experiment().diagonal.front().settled_rms, std::sqrt(all), 0.06 * std::sqrt(all));
  EXPECT_NEAR(experiment().jerk.front().settled_rms, std::sqrt(all), 0.06 * std::sqrt(all));
}

TEST(NoiseExperiment, WithMoreEndsWhereItsSettledGainEnds) {
  Eigen::Matrix3d jerk;
  jerk << 1.0 / 20, 1.0 / 8, 1.0 / 6, 1.0 / 8, 1.0 / 3, 1.0 / 2, 1.0 / 6, 1.0 / 2, 1.0;
  for (const std::size_t i : {9U, 12U, 15U}) {  // ratios 1, 10, 100
    const double square = std::pow(experiment().diagonal[i].ratio, 2);
    const double diagonal = settledDeviation(square * Eigen::Matrix3d::Identity());
    EXPECT_NEAR(experiment().diagonal[i].settled_rms, diagonal, 0.06 * diagonal) << i;
    const double white = settledDeviation(square * jerk);
    EXPECT_NEAR(experiment().jerk[i].settled_rms, white, 0.06 * white) << i;
  }
}

TEST(NoiseExperiment, TheLessIsPushedIntoTheFilterTheBetterItPredictsAnEvenMotion) {
  for (const auto* rows : {&experiment().diagonal, &experiment().jerk}) {
    for (std::size_t i = 1; i < rows->size(); ++i) {
      EXPECT_GE((*rows)[i].settled_rms, 0.99 * (*rows)[i - 1].settled_rms);
    }
    EXPECT_GT(rows->back().settled_rms, 3.0 * rows->front().settled_rms);
  }
}

TEST(NoiseExperiment, AFilterThatDoubtsTooMuchSaysSoByItsNis) {
  EXPECT_NEAR(experiment().diagonal.front().nis, 1.0, 0.05);
  EXPECT_LT(experiment().diagonal.back().nis, 0.01);
}

TEST(NoiseExperiment, TellsItsResultsInTheReportsMillimetres) {
  const auto json = nlohmann::json::parse(noiseJson(experiment()));
  EXPECT_NEAR(json["no_process_noise_mm"], 0.785 * parabolaDeviation(20), 1e-9);
  ASSERT_EQ(json["diagonal"].size(), experiment().diagonal.size());
  EXPECT_NEAR(json["white_jerk"][0]["mean_error_mm"], 0.785 * experiment().jerk[0].mean, 1e-12);
  const std::string table = noiseTable(experiment());
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'),
            static_cast<long>(2 * (experiment().diagonal.size() + 3)));
}

}  // namespace
}  // namespace ringhook
