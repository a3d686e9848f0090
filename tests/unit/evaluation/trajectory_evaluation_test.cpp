#include "evaluation/trajectory_evaluation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "core/error.h"
#include "evaluation/trajectory_models.h"
#include "evaluation/trajectory_outputs.h"
#include "prediction/linear_motion.h"

namespace ringhook {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kStep = 0.01;

Trajectory sampled(int samples, const std::function<Eigen::VectorXd(double)>& path,
                   TrajectoryKind kind) {
  Trajectory trajectory{"made", kind, {}, {}};
  for (int i = 0; i < samples; ++i) {
    trajectory.times.push_back(Time::fromSeconds(i * kStep));
    trajectory.values.push_back(path(i * kStep));
  }
  return trajectory;
}

Trajectory sine(int samples, double sigma = 0.0) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  return sampled(
      samples,
      [&](double t) {
        return Eigen::VectorXd::Constant(1, 0.2 * std::cos(5.0 * t) + sigma * normal(random));
      },
      TrajectoryKind::kAngle);
}

/// Says what `law` says of an instant and its last sample, from `begin` samples on.
class Told : public MotionModel {
 public:
  using Law = std::function<Eigen::VectorXd(double ahead_s, const Eigen::VectorXd& last)>;
  explicit Told(Law law, int begin = 1, FilterUpdate update = {})
      : law_(std::move(law)), begin_(begin), update_(update) {}
  [[nodiscard]] std::string name() const override { return "told"; }
  Outcome<FilterUpdate> update(Time time, const Eigen::VectorXd& value) override {
    time_ = time;
    last_ = value;
    ++seen_;
    return update_;
  }
  [[nodiscard]] Outcome<Gaussian<Eigen::Dynamic>> predict(Time time) const override {
    if (seen_ < begin_) {
      return Refusal{"not started yet"};
    }
    const Eigen::VectorXd mean = law_(time - time_, last_);
    return Gaussian<Eigen::Dynamic>{mean, Eigen::MatrixXd::Identity(mean.size(), mean.size())};
  }

 private:
  Law law_;
  int begin_;
  FilterUpdate update_;
  Time time_;
  Eigen::VectorXd last_;
  int seen_ = 0;
};

const Told::Law kStay = [](double, const Eigen::VectorXd& last) { return last; };

TEST(HorizonTruth, LiesOnTheLineBetweenTheSamplesAboutIt) {
  const Trajectory swing = sine(100);
  const HorizonTruth between = truthAhead(swing, 0.034);
  EXPECT_NEAR(between.ahead(0, 10), 0.6 * swing.values[13](0) + 0.4 * swing.values[14](0), 1e-12);
  const HorizonTruth on = truthAhead(swing, 0.03);
  EXPECT_EQ(on.ahead(0, 10), swing.values[13](0));
  EXPECT_TRUE(std::isnan(on.ahead(0, 97)));
  EXPECT_EQ(on.ahead(0, 96), swing.values[99](0));
}

TEST(HorizonTruth, IsNotMadeUpInAGap) {
  Trajectory swing = sine(100);
  for (std::size_t i = 50; i < 100; ++i) {
    swing.times[i] = swing.times[i] + 0.06;
  }
  const HorizonTruth truth = truthAhead(swing, 0.02);
  EXPECT_TRUE(std::isnan(truth.ahead(0, 48)));
  EXPECT_FALSE(std::isnan(truth.ahead(0, 47)));
}

// 0.2 cos(5 (t + h)) - 0.2 cos(5 t) = -0.4 sin(5 h / 2) sin(5 t + 5 h / 2).
TEST(RunModel, AModelThatThinksNothingMovesIsWrongByTheMotion) {
  const Trajectory swing = sine(2000);
  const std::vector<HorizonTruth> truth = {truthAhead(swing, 0.1), truthAhead(swing, 0.3)};
  Told stay(kStay);
  const std::vector<ModelRun> runs = {runModel(stay, swing, truth)};
  const ModelSummary summary = summariseRuns(swing, truth, runs, 0.0).front();
  for (const HorizonResult& one : summary.horizons) {
    const double amplitude = 0.4 * std::sin(2.5 * one.horizon_s);
    EXPECT_NEAR(one.rms, amplitude / std::numbers::sqrt2, 0.02 * amplitude);
  }
  EXPECT_EQ(summary.horizons[0].samples, 1990U);
  EXPECT_EQ(summary.horizons[1].samples, 1970U);
}

TEST(RunModel, PointsHaveAnErrorPerAxisAndAHorizontalDistance) {
  const Trajectory resting = sampled(
      100, [](double) { return Eigen::Vector3d::Zero(); }, TrajectoryKind::kPoint);
  const std::vector<HorizonTruth> truth = {truthAhead(resting, 0.1)};
  Told off([](double, const Eigen::VectorXd&) { return Eigen::Vector3d(0.3, 0.4, 1.2); });
  const std::vector<ModelRun> runs = {runModel(off, resting, truth)};
  const HorizonResult result = summariseRuns(resting, truth, runs, 0.0).front().horizons.front();
  EXPECT_NEAR(result.rms, 1.3 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(*result.horizontal_rms, 0.5, 1e-12);
}

TEST(RunModel, WhatComesLaterChangesNothingThatWasPredicted) {
  const Trajectory whole = sine(400, 1e-3);
  Trajectory other = whole;
  for (std::size_t i = 200; i < 400; ++i) {
    other.values[i](0) += 5.0;
  }
  const std::vector<HorizonTruth> truth = {truthAhead(whole, 0.1)};
  const auto errorsOn = [&truth](const Trajectory& trajectory) {
    const auto model = makeConstantAcceleration(trajectory.kind, {1e-3, 1.0});
    return runModel(*model, trajectory, truth).errors.front();
  };
  const Eigen::MatrixXd a = errorsOn(whole);
  const Eigen::MatrixXd b = errorsOn(other);
  EXPECT_EQ(a.leftCols(200), b.leftCols(200));
  EXPECT_GT(std::abs(a(0, 220) - b(0, 220)), 0.5);
}

TEST(SummariseRuns, JudgesAllModelsOnTheSamplesWhereTheSlowestPredicts) {
  const Trajectory swing = sine(300);
  const std::vector<HorizonTruth> truth = {truthAhead(swing, 0.1)};
  Told quick(kStay);
  Told slow(kStay, 120);
  Told never(kStay, 1000);
  std::vector<ModelRun> runs;
  for (Told* model : {&quick, &slow, &never}) {
    runs.push_back(runModel(*model, swing, truth));
  }
  EXPECT_EQ(firstJudged(swing, runs, 0.5), 119U);
  EXPECT_EQ(firstJudged(swing, runs, 1.5), 150U);
  EXPECT_EQ(firstJudged(swing, {runs[2]}, 0.1), 10U);
  const auto summaries = summariseRuns(swing, truth, runs, 0.5);
  EXPECT_EQ(summaries[0].horizons[0].samples, 300U - 10U - 119U);
  EXPECT_EQ(summaries[1].horizons[0].samples, 300U - 10U - 119U);
  EXPECT_EQ(summaries[0].horizons[0].rms, summaries[1].horizons[0].rms);
  EXPECT_FALSE(summaries[2].predicts);
  EXPECT_TRUE(summaries[2].horizons.empty());
}

TEST(SummariseRuns, CountsNisInsideItsBand) {
  const Trajectory swing = sine(200);
  const std::vector<HorizonTruth> truth = {truthAhead(swing, 0.1)};
  Told model(kStay, 1, FilterUpdate{{}, 4.0, 1});
  std::vector<ModelRun> runs = {runModel(model, swing, truth)};
  for (std::size_t i = 150; i < 200; ++i) {
    runs[0].updates[i].nis = 5.1;  // chi-square of 1: 0.001 to 5.02
  }
  const ModelSummary summary = summariseRuns(swing, truth, runs, 1.0).front();
  EXPECT_EQ(summary.nis_degrees, 1);
  EXPECT_NEAR(summary.nis_inside_95, 0.5, 1e-12);
  EXPECT_NEAR(summary.nis_mean, 4.55, 1e-12);
}

TEST(ChosenModels, AreAllOrTheNamedOnesInTheirOrder) {
  EXPECT_EQ(chosenModels({}), motionModelNames());
  EXPECT_EQ(chosenModels({"all"}), motionModelNames());
  const std::vector<std::string> two = {"constant-velocity", "exact-pendulum"};
  EXPECT_EQ(chosenModels(two), two);
  try {
    static_cast<void>(chosenModels({"magic"}));
    FAIL() << "an unknown model was taken";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("magic"), HasSubstr("constant-acceleration"),
                                HasSubstr("report-pendulum")));
  }
  EXPECT_THROW(static_cast<void>(chosenModels({"exact-pendulum", "exact-pendulum"})), InputError);
}

TEST(TunedModels, PredictNoWorseThanWithAnyDensityOfAGrid) {
  const Trajectory swing = sine(600, 1e-3);
  const std::vector<HorizonTruth> truth = {truthAhead(swing, 0.1)};
  const ModelSettings settings{1e-3, {}, 0.0};
  const auto rmsOf = [&](MotionModel& model) {
    const std::vector<ModelRun> runs = {runModel(model, swing, truth)};
    return summariseRuns(swing, truth, runs, 1.0).front().horizons.front().rms;
  };
  const auto tuned = makeTunedModel("constant-acceleration", swing, truth, settings, 1.0);
  const double best = rmsOf(*tuned.model);
  EXPECT_EQ(tuned.densities.size(), 1U);
  for (double density = 1e-4; density < 1e5; density *= 10.0) {
    EXPECT_LE(best, 1.0001 * rmsOf(*makeConstantAcceleration(swing.kind, {1e-3, density})));
  }
}

TEST(EvaluateTrajectory, PutsThePendulumBeforeModelsWithoutGravity) {
  const Trajectory swing = sine(600, 1e-3);
  const TrajectoryResult result = evaluateTrajectory(swing, {});
  EXPECT_TRUE(result.noise_estimated);
  EXPECT_NEAR(result.noise, 1e-3, 2e-4);
  ASSERT_EQ(result.summaries.size(), motionModelNames().size());
  const auto rmsOf = [&result](const std::string& name) {
    for (const ModelSummary& summary : result.summaries) {
      if (summary.name == name) {
        return summary.horizons.front().rms;
      }
    }
    return 0.0;
  };
  EXPECT_LT(rmsOf("exact-pendulum"), 2e-3);
  EXPECT_GT(rmsOf("constant-acceleration"), 3.0 * rmsOf("exact-pendulum"));
  EXPECT_GT(rmsOf("constant-velocity"), rmsOf("constant-acceleration"));
}

TEST(EvaluateTrajectory, RefusesOptionsOutOfRangeByName) {
  const Trajectory swing = sine(300);
  const auto refusal = [&swing](const TrajectoryEvaluationOptions& options) -> std::string {
    try {
      static_cast<void>(evaluateTrajectory(swing, options));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(refusal({{}, {0.1, 0.0}, {}, {}, 1.0}), HasSubstr("--horizons: expected a number"));
  EXPECT_THAT(refusal({{}, {3.0}, {}, {}, 1.0}), HasSubstr("--horizons 3: expected less than"));
  EXPECT_THAT(refusal({{}, {0.1, 0.1}, {}, {}, 1.0}), HasSubstr("each number once"));
  EXPECT_THAT(refusal({{}, {0.1}, -1.0, {}, 1.0}), HasSubstr("--noise"));
  EXPECT_THAT(refusal({{}, {0.1}, {}, 0.0, 1.0}), HasSubstr("--length"));
  EXPECT_THAT(refusal({{}, {0.1}, {}, {}, 9.0}), HasSubstr("--warm-up"));
  EXPECT_THAT(refusal({{"magic"}, {0.1}, {}, {}, 1.0}), HasSubstr("--models"));
}

TEST(TrajectoryOutputs, HoldTheKeysThatProgramsRelyOn) {
  const TrajectoryResult result = evaluateTrajectory(sine(600, 1e-3), {});
  const auto json = nlohmann::json::parse(trajectoryJson(result));
  EXPECT_EQ(json["model"], motionModelNames().front());
  ASSERT_EQ(json["horizons"].size(), 3U);
  EXPECT_THAT(json["models"]["exact-pendulum"]["note"].get<std::string>(),
              AllOf(HasSubstr("from the first"), HasSubstr("chosen in hindsight: ")));
  EXPECT_EQ(json["horizons"][1]["horizon_s"], 0.2);
  EXPECT_EQ(json["horizons"][1]["unit"], "rad");
  EXPECT_GT(json["horizons"][1]["samples"], 100);
  EXPECT_NEAR(json["models"]["exact-pendulum"]["parameters"]["length_m"], 9.81 / 25.0, 0.01);
  EXPECT_GT(json["models"]["exact-pendulum"]["parameters"]["length_m_std"], 0.0);
  EXPECT_TRUE(json["models"]["exact-pendulum"]["parameters"].contains("damping_per_s"));
  for (const auto& name : motionModelNames()) {
    EXPECT_TRUE(json["models"][name].contains("nis_mean")) << name;
    EXPECT_TRUE(json["models"][name].contains("nis_inside_95")) << name;
    EXPECT_EQ(json["models"][name]["horizons"].size(), 3U) << name;
  }
}

TEST(TrajectoryOutputs, HaveARowASampleWithAsManyFieldsAsTheHeader) {
  const TrajectoryResult result = evaluateTrajectory(sine(200, 1e-3), {});
  std::istringstream csv(trajectoryCsv(result));
  std::string line;
  std::getline(csv, line);
  EXPECT_THAT(line, AllOf(HasSubstr("time_s,angle_rad,"), HasSubstr("exact-pendulum_length_m_std"),
                          HasSubstr("constant-velocity_error_0.2s_angle_rad")));
  const auto commas = std::count(line.begin(), line.end(), ',');
  int rows = 0;
  for (; std::getline(csv, line); ++rows) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas);
  }
  EXPECT_EQ(rows, 200);
}

}  // namespace
}  // namespace ringhook
