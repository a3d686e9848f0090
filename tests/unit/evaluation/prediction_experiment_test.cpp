// The prediction experiment on two seeds a row: that it runs whole, says what it measured, and that
// the swing filter is far better than what knows nothing of gravity.

#include "evaluation/prediction_experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace ringhook {
namespace {

PredictionRow rowOf(const PredictionExperiment& experiment, const std::string& key) {
  const auto& rows = experiment.rows;
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.key == key; });
  return row == rows.end() ? PredictionRow{"", "", {-1.0, -1.0, -1.0}} : *row;
}

double farRms(const PredictionExperiment& experiment, const std::string& key) {
  return rowOf(experiment, key).rms_mm.back();
}

double farNees(const PredictionExperiment& experiment, const std::string& key) {
  return rowOf(experiment, key).nees;
}

// One run for all: it takes some ten seconds.
TEST(PredictionExperiment, FindsTheSwingFilterWithinItsGoalsAndFarAheadOfItsPeers) {
  const PredictionExperiment experiment = runPredictionExperiment({2, 2, 2}, [](double) {});
  for (const std::string swing : {"5", "15"}) {
    const double ours = farRms(experiment, "points_" + swing + "_deg_spherical-pendulum");
    ASSERT_GT(ours, 0.0);
    EXPECT_LT(10.0 * ours, farRms(experiment, "points_" + swing + "_deg_constant-acceleration"));
    EXPECT_LT(ours, farRms(experiment, "points_" + swing + "_deg_report-pendulum"));
  }
  // 1 per degree of freedom is honest; the report's filter does not know how wrong it is.
  EXPECT_LT(farNees(experiment, "points_5_deg_spherical-pendulum"), 4.0);
  EXPECT_GT(farNees(experiment, "points_5_deg_report-pendulum"), 50.0);
  EXPECT_GT(experiment.consistency.nees_mean, 0.2);
  EXPECT_LT(experiment.consistency.nees_mean, 3.0);
  EXPECT_LT(farRms(experiment, "poses_5_deg"), 0.2);
  EXPECT_LT(farRms(experiment, "poses_15_deg"), 0.35);
  for (const StopResult* stop : {&experiment.stop, &experiment.stop_points}) {
    EXPECT_EQ(stop->back, stop->seeds);
    EXPECT_EQ(stop->diverged, 0);
  }
  EXPECT_EQ(experiment.stop.noticed, experiment.stop.seeds);
  EXPECT_LT(experiment.smoother.smoother_mm, experiment.smoother.filter_mm);
  const auto json = nlohmann::json::parse(predictionJson(experiment));
  EXPECT_TRUE(json["simulated"]);
  EXPECT_NEAR(json["rows"]["poses_5_deg"]["rms_300_ms_mm"], farRms(experiment, "poses_5_deg"),
              1e-12);
  EXPECT_NE(predictionTable(experiment).find("constant-acceleration"), std::string::npos);
}

}  // namespace
}  // namespace ringhook
