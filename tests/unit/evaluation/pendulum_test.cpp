#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "../../support/scratch_folder.h"
#include "core/angle.h"
#include "evaluation/hanging_hook.h"
#include "evaluation/pendulum_experiment.h"
#include "evaluation/pendulum_theory.h"
#include "sim/hook_body.h"

namespace ringhook {
namespace {

constexpr double kPi = std::numbers::pi;

double smallPeriod() { return 2.0 * kPi * std::sqrt(1.0 / 9.81); }

TEST(PendulumTheory, ExactPeriodIsTheEllipticIntegral) {
  for (const double amplitude : {1e-6, 0.1, 0.5, 1.0, 2.0, 3.0}) {
    const double elliptic = 2.0 / kPi * std::comp_ellint_1(std::sin(0.5 * amplitude));
    EXPECT_NEAR(exactPeriod(1.0, amplitude), elliptic, 1e-12 * elliptic);
  }
  EXPECT_NEAR(exactPeriod(smallPeriod(), 1.0), 2.1392, 1e-4);
}

TEST(PendulumTheory, IntegratedEquationHasTheExactPeriodAndKeepsItsEnergy) {
  const PendulumOptions options;
  const auto samples = referencePendulum(options, 0.01, 20.0);
  EXPECT_NEAR(measuredPeriod(samples), exactPeriod(smallPeriod(), 1.0), 1e-7);
  EXPECT_NEAR(pendulumEnergy(options, samples.back()), 9.81 * (1.0 - std::cos(1.0)), 1e-9);
}

TEST(PendulumTheory, TheReportsMapTurnsByTheAngleOfItsEigenvalues) {
  PendulumOptions options;
  const double dt = 0.05;
  const double turn = std::acos(1.0 - 0.5 * 9.81 * dt * dt);
  EXPECT_NEAR(measuredPeriod(reportPendulum(options, dt, 60.0)), 2.0 * kPi * dt / turn, 1e-4);
  // With damping its determinant is 1 - D dt: amplitudes shrink by the square root of it a step.
  options.damping = 0.5;
  const auto damped = reportPendulum(options, dt, 60.0);
  const auto amplitude = [&](std::size_t i) {
    const double angle = damped[i].angle;
    const double next = damped[i + 1].angle;
    const double c = 0.5 * (1.0 - 9.81 * dt * dt + 1.0 - 0.5 * dt) / std::sqrt(0.975);
    const double quadrature = (next / std::sqrt(0.975) - c * angle) / std::sqrt(1.0 - c * c);
    return std::hypot(angle, quadrature);
  };
  EXPECT_NEAR(amplitude(200) / amplitude(0), std::pow(0.975, 100.0), 1e-9);
}

TEST(PendulumWorld, UndampedItKeepsItsEnergyForAMinuteAndHasTheExactPeriod) {
  for (const auto stepping :
       {PendulumStepping::leapfrog, PendulumStepping::euler, PendulumStepping::rk4}) {
    PendulumOptions options;
    options.stepping = stepping;
    const auto samples = simulatePendulum(options, 60.0);
    const double exact = exactPeriod(smallPeriod(), 1.0);
    EXPECT_NEAR(measuredPeriod(samples), exact, 1e-3 * exact);
    const double start = 9.81 * (1.0 - std::cos(1.0));
    double least = start;
    for (const PendulumSample& sample : samples) {
      least = std::min(least, pendulumEnergy(options, sample));
    }
    const double bound = stepping == PendulumStepping::euler ? 3e-3 : 1e-5;
    EXPECT_GT(least, (1.0 - bound) * start);
    EXPECT_GT(pendulumEnergy(options, samples.back()), 0.999 * start);
  }
}

TEST(PendulumWorld, DampedSmallSwingsFollowTheClosedForm) {
  PendulumOptions options;
  options.damping = 0.5;
  options.start = 0.01;
  const double turn = std::sqrt(9.81 - 0.0625);
  for (const PendulumSample& s : simulatePendulum(options, 10.0)) {
    const double expected = 0.01 * std::exp(-0.25 * s.time_s) *
                            (std::cos(turn * s.time_s) + 0.25 / turn * std::sin(turn * s.time_s));
    ASSERT_NEAR(s.angle, expected, 1e-5) << s.time_s;
  }
}

TEST(HangingHook, KeepsItsEnergyForAMinuteSwingingInBothPlanes) {
  const double swing = 15.0 * kDegree;
  const HangingHookRun run = runHangingHook(hangingHookCell(swing, swing), 60.0);
  double least = run.energy.front();
  double most = least;
  for (const double energy : run.energy) {
    least = std::min(least, energy);
    most = std::max(most, energy);
  }
  std::printf("energy within %.2e and %.2e of its start over 60 s\n",
              least / run.energy.front() - 1.0, most / run.energy.front() - 1.0);
  EXPECT_GT(least, 0.9999 * run.energy.front());
  EXPECT_LT(most, 1.0001 * run.energy.front());
}

TEST(HangingHook, HasTheExactPeriodOfACompoundPendulum) {
  const HangingHookRun run = runHangingHook(hangingHookCell(0.25, 0.0), 12.0);
  const double amplitude = turningPoints(run.about_x).front();
  EXPECT_NEAR(amplitude, 0.25, 0.01);
  const double exact = exactPeriod(2.0 * kPi / swingFrequency(0.450, 0), amplitude);
  EXPECT_NEAR(measuredPeriod(run.about_x), exact, 2e-6 * exact);
}

TEST(PendulumExperiment, ItsOutputsHoldTheReportsNumbersBesideTheExactOnes) {
  PendulumExperiment experiment;
  PendulumCase one;
  one.name = "point mass";
  one.key = "undamped";
  one.small_period = smallPeriod();
  one.exact_period = exactPeriod(smallPeriod(), 1.0);
  PendulumRow row;
  row.name = "simulated";
  row.period = 2.14;
  row.energy_change = -0.0005;
  one.rows = {row};
  experiment.cases = {one};
  const PendulumOptions options;
  const auto trace = reportPendulum(options, 0.05, 1.0);
  experiment.traces = {{trace, trace, trace}, {trace, trace, trace}};
  const auto json = nlohmann::json::parse(pendulumJson(experiment));
  EXPECT_NEAR(json["undamped"]["exact_period_s"].get<double>(), 2.139138, 1e-6);
  EXPECT_EQ(json["undamped"]["rows"][0]["energy_change_per_minute_percent"], -0.05);
  EXPECT_FALSE(json["undamped"]["rows"][0].contains("angle_error_10_s_rad"));
  EXPECT_NE(pendulumTable(experiment).find("+0.0403"), std::string::npos)
      << "2.14 s against 2.139138 s in percent\n"
      << pendulumTable(experiment);
  const ScratchFolder scratch;
  const auto folder = scratch.path() / "out";
  writePendulumOutputs(folder, experiment);
  std::ifstream csv(folder / "trajectories.csv");
  std::string head;
  std::getline(csv, head);
  EXPECT_EQ(head.substr(0, 34), "time_s,d0_exact_angle_rad,d0_exact");
  int rows = 0;
  for (std::string line; std::getline(csv, line);) {
    ++rows;
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 12);
  }
  EXPECT_EQ(rows, 21);
  EXPECT_GT(std::filesystem::file_size(folder / "report.html"), 10000U);
}

}  // namespace
}  // namespace ringhook
