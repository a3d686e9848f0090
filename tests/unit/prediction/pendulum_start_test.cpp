#include "prediction/pendulum_start.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "outcome_text.h"
#include "prediction/pendulum_motion.h"

namespace ringhook {
namespace {

constexpr double kGravity = 9.81;
constexpr double kLength = 0.4;
constexpr double kDamping = 0.2;

/// A load and its pivot on a way that nobody plans: the pivot's path is a sum of sines, the load
/// obeys x'' = -(g/L)(x - p) - c (x' - p') and is walked by Runge-Kutta in steps of 1 ms.
struct Load {
  double position;
  double pivot;
};

double pivotAt(double t) {
  return 0.3 * t + 0.04 * std::sin(2.3 * t) + 0.02 * std::sin(5.1 * t + 1.0);
}
double pivotSpeedAt(double t) {
  return 0.3 + 0.092 * std::cos(2.3 * t) + 0.102 * std::cos(5.1 * t + 1.0);
}

std::vector<Load> loadUnderMovingPivot(double seconds, double frame_s) {
  constexpr double kStep = 1e-3;
  const auto rate = [](double t, const Eigen::Vector2d& s) {
    return Eigen::Vector2d(
        s.y(), -kGravity / kLength * (s.x() - pivotAt(t)) - kDamping * (s.y() - pivotSpeedAt(t)));
  };
  Eigen::Vector2d state(pivotAt(0.0) + 0.05, 0.3);
  std::vector<Load> loads;
  const int per_frame = static_cast<int>(std::lround(frame_s / kStep));
  for (int i = 0; i * kStep <= seconds; ++i) {
    const double t = i * kStep;
    if (i % per_frame == 0) {
      loads.push_back({state.x(), pivotAt(t)});
    }
    const Eigen::Vector2d a = rate(t, state);
    const Eigen::Vector2d b = rate(t + kStep / 2, state + kStep / 2 * a);
    const Eigen::Vector2d c = rate(t + kStep / 2, state + kStep / 2 * b);
    const Eigen::Vector2d d = rate(t + kStep, state + kStep * c);
    state += kStep / 6 * (a + 2 * b + 2 * c + d);
  }
  return loads;
}

SwingRecord dampedSwing(double seconds, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const double w = std::sqrt(kGravity / kLength - 0.25 * kDamping * kDamping);
  SwingRecord record;
  record.axes.resize(1);
  for (double t = 0.0; t < seconds; t += 0.01) {
    record.time_s.push_back(t);
    record.axes[0].push_back(0.1 * std::exp(-0.5 * kDamping * t) * std::cos(w * t + 0.4) +
                             sigma * normal(random));
  }
  return record;
}

TEST(PendulumFit, FindsLengthAndDampingOfANoiselessSwing) {
  const auto fit = fitPendulum(dampedSwing(2.0, 0.0, 1), kGravity);
  ASSERT_TRUE(fit.hasValue());
  EXPECT_NEAR(fit->length_m, kLength, 1e-7);
  EXPECT_NEAR(fit->damping_per_s, kDamping, 1e-6);
  EXPECT_NEAR(fit->periods, 2.0 / (2.0 * std::numbers::pi * std::sqrt(kLength / kGravity)), 0.02);
}

TEST(PendulumFit, KnowsHowWellItKnows) {
  double length_sum = 0.0;
  double damping_sum = 0.0;
  constexpr unsigned kRuns = 60;
  for (unsigned seed = 0; seed < kRuns; ++seed) {
    const auto fit = fitPendulum(dampedSwing(2.0, 2e-3, seed), kGravity);
    ASSERT_TRUE(fit.hasValue());
    length_sum += std::pow((fit->length_m - kLength) / fit->length_sigma_m, 2);
    damping_sum += std::pow((fit->damping_per_s - kDamping) / fit->damping_sigma_per_s, 2);
  }
  // Mean of 60 squares of standard normals: 0.18 is one standard deviation.
  EXPECT_NEAR(length_sum / kRuns, 1.0, 0.5);
  EXPECT_NEAR(damping_sum / kRuns, 1.0, 0.5);
}

TEST(PendulumFit, FollowsAMeasuredPivotWhereverItGoes) {
  SwingRecord record;
  record.axes.resize(1);
  record.pivots.resize(1);
  record.free_columns = 1;
  double t = 0.0;
  for (const Load& load : loadUnderMovingPivot(3.0, 0.01)) {
    record.time_s.push_back(t);
    record.axes[0].push_back(load.position + 0.007);  // a marker that sits beside
    record.pivots[0].push_back(load.pivot);
    t += 0.01;
  }
  const auto fit = fitPendulum(record, kGravity);
  ASSERT_TRUE(fit.hasValue());
  EXPECT_NEAR(fit->length_m, kLength, 1e-4);
  EXPECT_NEAR(fit->damping_per_s, kDamping, 2e-3);
  record.pivots.clear();
  record.free_columns = 2;
  const auto blind = fitPendulum(record, kGravity);  // takes the pivot to travel evenly
  ASSERT_TRUE(blind.hasValue());
  EXPECT_GT(blind->residual, 10.0 * fit->residual);
}

TEST(PendulumFit, SeesNoSwingInTooFewSamples) {
  const SwingRecord record = dampedSwing(0.05, 0.0, 1);
  EXPECT_EQ(reasonOf(fitPendulum(record, kGravity)), "too few samples");
}

TEST(PendulumStart, WaitsForOnePeriodAndLooksAtNothingLater) {
  const SwingRecord record = dampedSwing(4.0, 1e-3, 5);
  const double period = 2.0 * std::numbers::pi * std::sqrt(kLength / kGravity);
  PendulumMotionOptions options;
  const auto parametersAfter = [&](double seconds, double later_angle) {
    const auto model = makeExactPendulum(TrajectoryKind::kAngle, options);
    for (std::size_t i = 0; i < record.time_s.size(); ++i) {
      const double t = record.time_s[i];
      const double angle = t <= seconds ? record.axes[0][i] : later_angle;
      EXPECT_TRUE(
          model->update(Time::fromSeconds(t), Eigen::VectorXd::Constant(1, angle)).hasValue());
      if (t <= 0.9 * period) {
        EXPECT_TRUE(model->parameters().empty()) << t;
      }
    }
    return model->parameters();
  };
  const auto whole = parametersAfter(4.0, 0.0);
  ASSERT_EQ(whole.size(), 2U);
  EXPECT_EQ(whole[0].key, "length_m");
  EXPECT_NEAR(whole[0].value, kLength, 4.0 * whole[0].sigma);
  EXPECT_EQ(parametersAfter(2.0, 0.77)[0].value, whole[0].value);
}

TEST(PendulumStart, NeverBeginsWhereNothingSwings) {
  const auto model = makeReportPendulum(TrajectoryKind::kAngle, {});
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(model
                    ->update(Time::fromSeconds(0.02 * i),
                             Eigen::VectorXd::Constant(1, 1e-3 * normal(random)))
                    .hasValue());
  }
  EXPECT_EQ(reasonOf(model->predict(Time::fromSeconds(20.0))), "not started yet");
}

}  // namespace
}  // namespace ringhook
