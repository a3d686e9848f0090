#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "outcome_text.h"
#include "prediction/linear_motion.h"
#include "prediction/pendulum.h"
#include "prediction/pendulum_motion.h"
#include "prediction/pendulum_start.h"

namespace ringhook {
namespace {

using Model = std::unique_ptr<MotionModel>;
using Path = std::function<Eigen::VectorXd(double)>;

constexpr double kGravity = 9.81;
constexpr double kFrame = 0.02;

PendulumMotionOptions knownLength(double length_m) {
  PendulumMotionOptions options;
  options.sample_sigma = 1e-4;
  options.frame_s = kFrame;
  options.length_m = length_m;
  options.swing_density = options.pivot_density = options.height_density = 1e-8;
  return options;
}

/// All linear models of a kind, ready to begin.
std::vector<Model> allModels(TrajectoryKind kind) {
  std::vector<Model> models;
  models.push_back(makeConstantVelocity(kind, {}));
  models.push_back(makeConstantAcceleration(kind, {}));
  models.push_back(makeReportPendulum(kind, knownLength(0.4)));
  models.push_back(makeExactPendulum(kind, knownLength(0.4)));
  return models;
}

constexpr TrajectoryKind kKinds[] = {TrajectoryKind::kAngle, TrajectoryKind::kTwoAngles,
                                     TrajectoryKind::kPoint, TrajectoryKind::kPointAndPivot};

/// Gives the model `path` from 0 to `seconds` [s], with noise of standard deviation `sigma`.
void follow(MotionModel& model, const Path& path, double seconds, double sigma = 0.0,
            unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int i = 0; i * kFrame <= seconds + 1e-9; ++i) {
    Eigen::VectorXd value = path(i * kFrame);
    for (double& number : value) {
      number += sigma * normal(random);
    }
    ASSERT_TRUE(model.update(Time::fromSeconds(i * kFrame), value).hasValue());
  }
}

/// Largest distance between what is predicted for `seconds` and the path there.
double missed(const MotionModel& model, const Path& path, double seconds) {
  const auto then = model.predict(Time::fromSeconds(seconds));
  if (!then) {
    return std::numeric_limits<double>::infinity();
  }
  return (then->mean - path(seconds).head(then->mean.size())).cwiseAbs().maxCoeff();
}

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

/// A pivot at constant acceleration 0.3 m/s^2 along x with a load that swings below it as the
/// linear law has it, 0.05 m in y; both of the given kind.
Path travellingLoad(double length_m, TrajectoryKind kind, double acceleration) {
  return [=](double t) {
    const double w = std::sqrt(kGravity / length_m);
    const double x = 1.0 + 0.2 * t + 0.5 * acceleration * t * t;
    const double behind = -acceleration / (w * w) * (1.0 - std::cos(w * t));
    Eigen::VectorXd value(6);
    value << x + behind, 2.0 + 0.05 * std::cos(w * t), 0.5, x, 2.0, 0.5 + length_m;
    return Eigen::VectorXd(value.head(valueSize(kind)));
  };
}

TEST(MotionModel, HasNothingToSayBeforeTheFirstSample) {
  for (const TrajectoryKind kind : kKinds) {
    for (const Model& model : allModels(kind)) {
      EXPECT_EQ(reasonOf(model->predict(Time::fromSeconds(1.0))), "no measurement yet")
          << model->name();
    }
  }
}

TEST(MotionModel, RefusesWhatIsLateOrNoNumberAndKeepsItsBelief) {
  for (const TrajectoryKind kind : kKinds) {
    for (const Model& model : allModels(kind)) {
      const Eigen::VectorXd value = Eigen::VectorXd::Constant(valueSize(kind), 0.1);
      ASSERT_TRUE(model->update(Time::fromSeconds(1.0), value).hasValue());
      const auto before = model->predict(Time::fromSeconds(1.5));
      EXPECT_EQ(reasonOf(model->update(Time::fromSeconds(1.0), value)),
                "late or duplicate time stamp");
      Eigen::VectorXd broken = value;
      broken(0) = std::nan("");
      EXPECT_EQ(reasonOf(model->update(Time::fromSeconds(2.0), broken)), "not finite");
      EXPECT_EQ(model->predict(Time::fromSeconds(1.5))->mean, before->mean);
    }
  }
}

TEST(MotionModel, PredictsAsManyNumbersAsItsKindHasWithAProperCovariance) {
  for (const TrajectoryKind kind : kKinds) {
    for (const Model& model : allModels(kind)) {
      follow(
          *model, [kind](double) { return Eigen::VectorXd::Zero(valueSize(kind)); }, 0.2);
      const auto near = model->predict(Time::fromSeconds(0.2));
      const auto far = model->predict(Time::fromSeconds(1.0));
      ASSERT_EQ(near->mean.size(), predictedSize(kind)) << model->name();
      EXPECT_GT(near->covariance.diagonal().minCoeff(), 0.0) << model->name();
      EXPECT_TRUE((far->covariance.diagonal().array() >= near->covariance.diagonal().array()).all())
          << model->name();
    }
  }
}

TEST(ConstantVelocityModel, FollowsAStraightLineExactly) {
  const Path line = [](double t) { return Eigen::Vector3d(1.0 + 0.3 * t, -2.0 * t, 0.5); };
  const auto model = makeConstantVelocity(TrajectoryKind::kPoint, {1e-4, 1e-6});
  follow(*model, line, 1.0);
  EXPECT_LT(missed(*model, line, 1.7), 1e-5);
}

TEST(ConstantAccelerationModel, FollowsAParabolaExactlyAndAPlainerModelDoesNot) {
  const Path parabola = [](double t) { return Eigen::Vector3d(0.5 * t * t, 1.0 - t * t, 3.0 * t); };
  const auto model = makeConstantAcceleration(TrajectoryKind::kPoint, {1e-4, 1e-6});
  const auto plain = makeConstantVelocity(TrajectoryKind::kPoint, {1e-4, 1.0});
  follow(*model, parabola, 1.0);
  follow(*plain, parabola, 1.0);
  EXPECT_LT(missed(*model, parabola, 1.7), 1e-4);
  EXPECT_GT(missed(*plain, parabola, 1.7), 0.1);
}

TEST(ExactPendulumModel, FollowsTheLinearLawExactlyWhateverTheFrameTime) {
  const double w = std::sqrt(kGravity / 0.4);
  const Path swing = [w](double t) { return one(0.1 * std::cos(w * t + 0.3)); };
  const auto model = makeExactPendulum(TrajectoryKind::kAngle, knownLength(0.4));
  follow(*model, swing, 2.0);
  EXPECT_LT(missed(*model, swing, 2.9), 1e-5);
}

TEST(ExactPendulumModel, KnowsThatAPivotWhichAcceleratesDrivesTheSwing) {
  constexpr auto kKind = TrajectoryKind::kPointAndPivot;
  const Path path = travellingLoad(0.4, kKind, 0.3);
  const auto model = makeExactPendulum(kKind, knownLength(0.4));
  const auto separate = makeReportPendulum(kKind, knownLength(0.4));
  follow(*model, path, 2.0);
  follow(*separate, path, 2.0);
  EXPECT_LT(missed(*model, path, 2.5), 1e-4);
  EXPECT_GT(missed(*separate, path, 2.5), 2e-3);  // the report models belt and hook apart
}

TEST(ExactPendulumModel, FindsThePivotOfALoadSeenAlone) {
  const Path path = travellingLoad(0.4, TrajectoryKind::kPoint, 0.0);
  const auto model = makeExactPendulum(TrajectoryKind::kPoint, knownLength(0.4));
  follow(*model, path, 2.0);
  EXPECT_LT(missed(*model, path, 2.5), 1e-4);
}

// cos(w' dt) = 1 - g dt^2/(2L): with the report's dt = 0.05 s and L = 1 m its swing runs 0.1 %
// fast.
TEST(ReportPendulumModel, SwingsWithThePeriodOfItsOwnMap) {
  PendulumMotionOptions options = knownLength(1.0);
  options.frame_s = 0.05;
  options.swing_density = 1e-12;
  const double mapped = std::acos(1.0 - kGravity * 0.05 * 0.05 / 2.0) / 0.05;
  const Path own = [mapped](double t) { return one(0.1 * std::cos(mapped * t)); };
  const auto model = makeReportPendulum(TrajectoryKind::kAngle, options);
  for (int i = 0; i <= 200; ++i) {
    ASSERT_TRUE(model->update(Time::fromSeconds(0.05 * i), own(0.05 * i)).hasValue());
  }
  const double w = std::sqrt(kGravity);
  const Path real = [w](double t) { return one(0.1 * std::cos(w * t)); };
  double late = 0.0;
  for (double t = 40.0; t < 42.0; t += 0.05) {
    EXPECT_LT(missed(*model, own, t), 1e-4);
    late = std::max(late, missed(*model, real, t));
  }
  EXPECT_NEAR(late, 0.1 * (mapped - w) * 41.0, 1e-3);
}

/// Mean NIS per degree of a model on a law that is its own, over seeds.
double meanNis(const std::function<Model()>& make, const Path& path, double sigma) {
  double sum = 0.0;
  int degrees = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const Model model = make();
    for (int i = 0; i < 200; ++i) {
      Eigen::VectorXd value = path(i * kFrame);
      for (double& number : value) {
        number += sigma * normal(random);
      }
      const auto update = model->update(Time::fromSeconds(i * kFrame), value);
      sum += i < 50 ? 0.0 : update->nis;
      degrees += i < 50 ? 0 : update->degrees;
    }
  }
  return sum / degrees;
}

TEST(MotionModel, IsConsistentOnAMotionOfItsOwnLaw) {
  const double sigma = 1e-3;
  PendulumMotionOptions options = knownLength(0.4);
  options.sample_sigma = sigma;
  constexpr auto kKind = TrajectoryKind::kPointAndPivot;
  const auto make = [&] { return makeExactPendulum(kKind, options); };
  // 15 000 degrees: one standard deviation is 0.012.
  EXPECT_NEAR(meanNis(make, travellingLoad(0.4, kKind, 0.3), sigma), 1.0, 0.04);
  const auto plain = [&] {
    return makeConstantAcceleration(TrajectoryKind::kPoint, {sigma, 1e-8});
  };
  const Path parabola = [](double t) { return Eigen::Vector3d(0.2 * t * t, t, 0.0); };
  EXPECT_NEAR(meanNis(plain, parabola, sigma), 1.0, 0.05);
}

}  // namespace
}  // namespace ringhook
