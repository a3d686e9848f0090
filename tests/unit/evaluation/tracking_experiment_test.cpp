#include "evaluation/tracking_experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace ringhook {
namespace {

/// Positions of an even motion along y, each displaced by `displacement(i)` [m], once a second, and
/// said to be known to `sigma` [m].
template <class Displacement>
std::vector<TrackingStep> evenSteps(const Displacement& displacement, double sigma = 1e-4) {
  std::vector<TrackingStep> steps(21);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double at = static_cast<double>(i);
    steps[i].truth << 0.42, 0.03 * at - 0.3, 0.8, 0.0, 0.03, 0.0, 0.0, 0.0, 0.0;
    steps[i].seen_f = steps[i].truth.head<3>() + displacement(static_cast<int>(i));
    steps[i].covariance_f = sigma * sigma * Eigen::Matrix3d::Identity();
  }
  predictSteps(steps);
  return steps;
}

TEST(TrackingErrors, AConstantOffsetIsInThePositionsButNeitherInStepsNorInSpeeds) {
  const auto steps = evenSteps([](int) { return Eigen::Vector3d(0.001, -0.002, 0.003); });
  const TrackingErrors errors = errorsOf(steps);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(errors.seen[i].mean, static_cast<double>(i + 1), 1e-9);
    EXPECT_NEAR(errors.by_acceleration[i].mean, static_cast<double>(i + 1), 1e-4);
    EXPECT_NEAR(errors.by_velocity[i].mean, static_cast<double>(i + 1), 1e-4);
  }
  EXPECT_NEAR(errors.distance.mean, 0.0, 1e-9);
  for (std::size_t state = 3; state < 9; ++state) {
    EXPECT_NEAR(errors.by_acceleration[state].mean, 0.0, 1e-4) << state;
    EXPECT_NEAR(errors.by_velocity[state].mean, 0.0, 1e-4) << state;
  }
}

TEST(TrackingErrors, AreMeanAndDeviationOfTheirSizes) {
  // x alternates between +1 and -3 mm: sizes 1 and 3, eleven of the one and ten of the other.
  const auto steps =
      evenSteps([](int i) { return Eigen::Vector3d(i % 2 == 0 ? 0.001 : -0.003, 0.0, 0.0); });
  const TrackingErrors errors = errorsOf(steps);
  const double mean = (11.0 * 1.0 + 10.0 * 3.0) / 21.0;
  const double square = (11.0 * std::pow(1.0 - mean, 2) + 10.0 * std::pow(3.0 - mean, 2)) / 20.0;
  EXPECT_NEAR(errors.seen[0].mean, mean, 1e-9);
  EXPECT_NEAR(errors.seen[0].deviation, std::sqrt(square), 1e-9);
  EXPECT_NEAR(errors.distance.mean, std::hypot(4.0, 30.0) - 30.0, 1e-9);
}

TEST(TrackingErrors, ThePredictionOfAnEvenMotionIsTheLineThroughAllItsPositions) {
  // One displaced position: least squares by hand tells every later prediction. Noise so large that
  // the wandering of the speed is nothing beside it.
  constexpr int kOdd = 4;
  const auto steps =
      evenSteps([](int i) { return Eigen::Vector3d(i == kOdd ? 0.001 : 0.0, 0.0, 0.0); }, 0.02);
  EXPECT_FALSE(steps[2].by_velocity);
  ASSERT_TRUE(steps[3].by_velocity);
  EXPECT_NEAR((*steps[4].by_velocity)(0), 0.42, 1e-8);
  for (int n = kOdd + 1; n < 21; ++n) {  // samples 0 .. n - 1 predict n
    const double middle = 0.5 * (n - 1);
    const double spread = n * (n * n - 1.0) / 12.0;
    const double weight = 1.0 / n + (kOdd - middle) * (n - middle) / spread;
    EXPECT_NEAR((*steps[static_cast<std::size_t>(n)].by_velocity)(0), 0.42 + 0.001 * weight, 3e-6)
        << n;
  }
}

double oneStep(const TrackingCase& view) {
  return meanOf(std::span(view.errors.by_acceleration).first<3>()).mean;
}

void seesAllCornersInBothPictures(const TrackingCase& view) {
  ASSERT_EQ(view.steps.size(), 21U);
  for (const TrackingStep& step : view.steps) {
    EXPECT_EQ(step.features, 32);
  }
}

void truthIsStepsOfTheReportsLength(const std::vector<TrackingStep>& steps) {
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const Vector9 change = steps[i].truth - steps[i - 1].truth;
    EXPECT_NEAR(change(1), 0.02934, 1e-7);
    EXPECT_LT(std::hypot(change(0), change(2)), 1e-6);
    EXPECT_NEAR(steps[i].truth(4), 0.02934, 1e-6);
    EXPECT_LT(steps[i].truth.tail<3>().norm(), 1e-6);
  }
}

// The rig's error is a rigid motion, the same for all pairs, and filters are linear: it passes
// through them and takes next to nothing from what they say of speed and acceleration.
void camerasPlaceShiftsPositionsAlone(const std::vector<TrackingStep>& told,
                                      const std::vector<TrackingStep>& real) {
  const Eigen::Vector3d first = told[0].seen_f - real[0].seen_f;
  EXPECT_GT(first.norm(), 2e-5);
  for (std::size_t i = 3; i < told.size(); ++i) {
    EXPECT_LT((told[i].seen_f - real[i].seen_f - first).norm(), 3e-4);
    EXPECT_LT((*told[i].by_acceleration - *real[i].by_acceleration).tail<6>().norm(), 3e-5);
  }
}

void putsTheReportsNumbersBesideItsOwn(const TrackingExperiment& experiment) {
  const auto json = nlohmann::json::parse(trackingJson(experiment));
  EXPECT_EQ(json["report"]["predicted_position_mm"]["mean"], 2.499);
  const auto& own = json["sequences"][0]["plate_as_told"]["constant_acceleration"];
  double sum = 0.0;
  for (const char* state : {"x_mm", "y_mm", "z_mm", "vx_mm_s", "vy_mm_s", "vz_mm_s", "ax_mm_s2",
                            "ay_mm_s2", "az_mm_s2"}) {
    sum += own[state]["mean"].get<double>();
  }
  EXPECT_NEAR(own["nine_states"]["mean"].get<double>(), sum / 9.0, 1e-12);
  const std::string table = trackingTable(experiment);
  for (const char* number : {"2.370", "2.499", "1.117", "1.014", "0.637"}) {
    EXPECT_NE(table.find(number), std::string::npos) << number;
  }
}

TEST(TrackingExperiment, PredictsOneStepWithinTwoTenthsOfAMillimetre) {
  const TrackingExperiment experiment = runTrackingExperiment({.first_seed = 1, .sequences = 3});
  ASSERT_EQ(experiment.sequences.size(), 3U);
  double as_told = 0.0;
  for (const TrackingSequence& sequence : experiment.sequences) {
    const auto& views = sequence.views;
    seesAllCornersInBothPictures(views[kPlateAsTold]);
    truthIsStepsOfTheReportsLength(views[kPlateAsTold].steps);
    camerasPlaceShiftsPositionsAlone(views[kPlateAsTold].steps, views[kPlateTrueRig].steps);
    as_told += oneStep(views[kPlateAsTold]) / 3.0;
    EXPECT_LT(oneStep(views[kPlateTrueRig]), TrackingExperiment::kGoalMm);
    EXPECT_LT(views[kPlateAsTold].errors.distance.mean, 0.1);
    EXPECT_LT(meanOf(views[kPlateAsTold].errors.by_acceleration).mean, 0.2);
  }
  EXPECT_LE(as_told, TrackingExperiment::kGoalMm);
  putsTheReportsNumbersBesideItsOwn(experiment);
}

}  // namespace
}  // namespace ringhook
