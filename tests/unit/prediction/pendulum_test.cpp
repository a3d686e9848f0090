#include "prediction/pendulum.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>

#include "outcome_text.h"

namespace ringhook {
namespace {

// The 2007 report's experiment, section 5.2.2.
PendulumParameters reportPendulum(double damping) { return {1.0, 1.0, damping, 9.81, 0.05}; }

// Period [s] from the first and last downward zero crossings of phi, between samples.
double measuredPeriod(const std::vector<Eigen::Vector2d>& states, double dt) {
  std::vector<double> crossings;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const double before = states[i - 1].x();
    const double after = states[i].x();
    if (before > 0.0 && after <= 0.0) {
      crossings.push_back((static_cast<double>(i - 1) + before / (before - after)) * dt);
    }
  }
  if (crossings.size() < 2) {
    return 0.0;
  }
  return (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
}

TEST(PendulumMap, HasTheReportsEntries) {
  const Eigen::Matrix2d A = pendulumMap({0.8, 2.0, 0.5, 9.81, 0.05}, 0.05);
  EXPECT_DOUBLE_EQ(A(0, 0), 1.0 - 9.81 * 0.0025 / 0.8);
  EXPECT_DOUBLE_EQ(A(0, 1), (1.0 - 0.5 * 0.05 / 2.0) * 0.05 / 0.8);
  EXPECT_DOUBLE_EQ(A(1, 0), -9.81 * 0.05);
  EXPECT_DOUBLE_EQ(A(1, 1), 1.0 - 0.5 * 0.05 / 2.0);
}

TEST(PendulumMap, KeepsAreaWithoutDampingAndShrinksItWith) {
  EXPECT_NEAR(pendulumMap(reportPendulum(0.0), 0.05).determinant(), 1.0, 1e-15);
  EXPECT_NEAR(pendulumMap(reportPendulum(0.5), 0.05).determinant(), 1.0 - 0.5 * 0.05, 1e-15);
}

TEST(PendulumMap, SwingsForEverWithoutDamping) {
  double largest = 0.0;
  for (const auto& state :
       simulatePendulum(reportPendulum(0.0), PendulumLaw::kLinear, 1.0, 200000)) {
    largest = std::max(largest, std::abs(state.x()));
  }
  // phi_k = C cos(k t + d) with cos t = 1 - a/2, a = g dt^2/L, through (1, 0): C^2 = 1/(1 - a/4).
  EXPECT_NEAR(largest, 1.0 / std::sqrt(1.0 - 9.81 * 0.0025 / 4.0), 1e-6);
}

TEST(PendulumMap, HasTheReportsPeriodUpToTheStepsOwnShift) {
  const PendulumParameters parameters = reportPendulum(0.0);
  const double ideal = 2.0 * std::numbers::pi * std::sqrt(1.0 / 9.81);
  const double shifted = 2.0 * std::numbers::pi / mapFrequency(parameters);
  const double measured =
      measuredPeriod(simulatePendulum(parameters, PendulumLaw::kLinear, 1.0, 20000), 0.05);
  RecordProperty("ideal_s", std::to_string(ideal));
  RecordProperty("map_s", std::to_string(measured));
  EXPECT_NEAR(ideal, 2.006, 0.0005);  // the report rounds to 2 s
  const double a = 9.81 * 0.0025;     // series of 2 asin(sqrt(a)/2)
  EXPECT_NEAR(shifted, ideal / (1.0 + a / 24.0 + 3.0 * a * a / 640.0), 1e-7);
  EXPECT_NEAR(measured, shifted, 2e-5);
}

// Exact period of the nonlinear pendulum from 1 rad: 2 pi sqrt(L/g) / agm(1, cos(1/2)).
TEST(PendulumSimulation, FromOneRadianTakesLongerThanTheReportsFormula) {
  double a = 1.0;
  double b = std::cos(0.5);
  for (int i = 0; i < 10; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  const double exact = 2.0 * std::numbers::pi * std::sqrt(1.0 / 9.81) / a;
  PendulumParameters fine = reportPendulum(0.0);
  fine.step_s = 0.001;
  const double measured =
      measuredPeriod(simulatePendulum(fine, PendulumLaw::kNonlinear, 1.0, 200000), 0.001);
  EXPECT_NEAR(measured, exact, 1e-4);
  EXPECT_NEAR(exact, 2.139, 0.001);
}

TEST(PendulumSimulation, DampingOfOneHalfDecaysAsTheLawSays) {
  const auto states = simulatePendulum(reportPendulum(0.5), PendulumLaw::kLinear, 1.0, 400);
  // |x| shrinks by sqrt(det) a step; after 20 s the exact law leaves exp(-0.25 * 20) = 0.0067.
  double late = 0.0;
  for (std::size_t i = 360; i < states.size(); ++i) {
    late = std::max(late, std::abs(states[i].x()));
  }
  EXPECT_GT(late, 0.5 * std::exp(-0.25 * 18.0));
  EXPECT_LT(late, 1.1 * std::exp(-0.25 * 18.0));
}

// Independent truth: the exact solution of phi'' + c phi' + w^2 phi = 0.
double exactAngle(double phi0, double rate0, double c, double w, double t) {
  const double wd = std::sqrt(w * w - 0.25 * c * c);
  return std::exp(-0.5 * c * t) *
         (phi0 * std::cos(wd * t) + (rate0 + 0.5 * c * phi0) / wd * std::sin(wd * t));
}

TEST(PendulumWalk, FollowsTheDifferentialEquationForAnyDuration) {
  const PendulumParameters parameters{0.35, 0.4, 0.04, 9.81, 0.002};
  const double w = std::sqrt(9.81 / 0.35);
  const Eigen::Vector2d start(0.1, 0.35 * 0.3);
  for (const double t : {0.0007, 0.0403, 0.1, 0.3331, 1.0}) {
    const Eigen::Vector2d end = walkPendulum(parameters, t, 0.0).transition * start;
    // v belongs half a step (1 ms) before its phi: at most w^2 phi * 1 ms of rate, 3 mrad/s.
    EXPECT_NEAR(end.x(), exactAngle(0.1, 0.3, 0.1, w, t), 0.003 * std::min(t, 1.0 / w) + 1e-5);
  }
}

TEST(PendulumWalk, GoesBackExactly) {
  const PendulumParameters parameters{0.35, 0.4, 0.04, 9.81, 0.002};
  const Eigen::Matrix2d there = walkPendulum(parameters, 0.123, 0.0).transition;
  const Eigen::Matrix2d back = walkPendulum(parameters, -0.123, 0.0).transition;
  EXPECT_TRUE((back * there).isIdentity(1e-12));
}

TEST(PendulumWalk, GathersTheNoiseThatAMonteCarloSees) {
  const PendulumParameters parameters{0.35, 0.4, 0.04, 9.81, 0.002};
  const double density = 1e-3;
  std::mt19937 random(7);
  std::normal_distribution<double> kick(0.0, std::sqrt(density * 1e-3));
  const double w2 = 9.81 / 0.35;
  Eigen::Matrix2d sampled = Eigen::Matrix2d::Zero();
  constexpr int kRuns = 20000;
  for (int run = 0; run < kRuns; ++run) {
    double phi = 0.0;
    double rate = 0.0;
    for (int i = 0; i < 200; ++i) {  // 0.2 s by 1 ms, kicked rate
      phi += 0.5e-3 * rate;
      rate += kick(random) - 1e-3 * (w2 * phi + 0.1 * rate);
      phi += 0.5e-3 * rate;
    }
    const Eigen::Vector2d x(phi, 0.35 * rate);
    sampled += x * x.transpose() / kRuns;
  }
  const Eigen::Matrix2d Q = walkPendulum(parameters, 0.2, density).noise;
  EXPECT_NEAR(sampled(0, 0) / Q(0, 0), 1.0, 0.05);
  EXPECT_NEAR(sampled(0, 1) / Q(0, 1), 1.0, 0.05);
  EXPECT_NEAR(sampled(1, 1) / Q(1, 1), 1.0, 0.05);
}

TEST(PendulumFilter, LocksOnTheSwingAtIrregularTimesAndPredictsIt) {
  PendulumFilterOptions options;
  options.pendulum = {0.35, 0.4, 0.04, 9.81, 0.002};
  options.acceleration_density = 1e-6;
  PendulumFilter filter(options);
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 1e-3);
  std::uniform_real_distribution<double> gap(0.005, 0.06);
  const double w = std::sqrt(9.81 / 0.35);
  double t = 0.0;
  while (t < 4.0) {
    t += gap(random);
    const double angle = exactAngle(0.1, 0.3, 0.1, w, t) + noise(random);
    ASSERT_TRUE(filter.update(Time::fromSeconds(t), angle, 1e-6));
  }
  const auto ahead = filter.predict(Time::fromSeconds(t + 0.3));
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->mean.x(), exactAngle(0.1, 0.3, 0.1, w, t + 0.3), 1.5e-3);
}

TEST(PendulumFilter, RefusesWithAReason) {
  PendulumFilterOptions options;
  options.gate_probability = 0.999;
  PendulumFilter filter(options);
  EXPECT_EQ(reasonOf(filter.predict(Time())), "no measurement yet");
  EXPECT_EQ(reasonOf(filter.update(Time(), NAN, 1.0)), "not finite");
  ASSERT_TRUE(filter.update(Time::fromSeconds(1.0), 0.1, 1e-6));
  EXPECT_EQ(reasonOf(filter.update(Time::fromSeconds(1.0), 0.1, 1e-6)),
            "late or duplicate time stamp");
  EXPECT_EQ(reasonOf(filter.update(Time::fromSeconds(1.01), 0.5, 1e-6)), "outside the gate");
}

}  // namespace
}  // namespace ringhook
