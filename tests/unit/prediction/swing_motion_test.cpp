#include "prediction/swing_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "outcome_text.h"
#include "prediction/singer_bank.h"

namespace ringhook {
namespace {

constexpr double kFrame = 0.02;    // [s]
constexpr double kLength = 0.153;  // [m]
constexpr double kStringLength = 2.0;

/// A large plane swing with both frictions by RK4: (angle, rate) a millisecond apart.
std::vector<double> largeSwing(double seconds) {
  const auto push = [](double a, double w) {
    return -9.81 / kLength * std::sin(a) - 0.05 * w - 0.1 * std::tanh(w / 0.02);
  };
  std::vector<double> angles;
  double a = 1.5;
  double w = 0.0;
  constexpr double h = 1e-3;
  for (int i = 0; i * h <= seconds; ++i) {
    angles.push_back(a);
    const double a1 = w, w1 = push(a, w);
    const double a2 = w + 0.5 * h * w1, w2 = push(a + 0.5 * h * a1, w + 0.5 * h * w1);
    const double a3 = w + 0.5 * h * w2, w3 = push(a + 0.5 * h * a2, w + 0.5 * h * w2);
    const double a4 = w + h * w3, w4 = push(a + h * a3, w + h * w3);
    a += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    w += h / 6.0 * (w1 + 2.0 * w2 + 2.0 * w3 + w4);
  }
  return angles;
}

double parameter(const MotionModel& model, const std::string& key) {
  for (const NamedParameter& one : model.parameters()) {
    if (one.key == key) {
      return one.value;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(SwingMotion, LearnsALargeSwingInOnePeriod) {
  const std::vector<double> swing = largeSwing(3.0);
  const auto model = makeSwingMotion(TrajectoryKind::kAngle, {3e-4, 9.81});
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 3e-4);
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < 2500; k += 10) {
    const Time now = Time::fromSeconds(static_cast<double>(k) * 1e-3);
    const Eigen::VectorXd value = Eigen::VectorXd::Constant(1, swing[k] + noise(random));
    (void)model->update(now, value).hasValue();
    if (k >= 1000) {
      const auto then = model->predict(now + 0.2);
      ASSERT_TRUE(then.hasValue());
      sum += std::pow(then->mean(0) - swing[k + 200], 2);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(sum / count), 3e-3);
  EXPECT_NEAR(parameter(*model, "length_m"), kLength, 0.01 * kLength);
}

/// A load on a string below a pivot that goes to and fro: linear below it, exactly periodic, with
/// the amplitude that x'' = (g / L) (pivot - x) has.
Eigen::VectorXd drivenLoad(double t) {
  constexpr double kDrive = 1.0;  // [rad/s]
  constexpr double kTravel = 0.1;
  const double w2 = 9.81 / kStringLength;
  const double pivot = kTravel * std::sin(kDrive * t);
  const double load = pivot * w2 / (w2 - kDrive * kDrive);
  const double off = load - pivot;
  Eigen::VectorXd value(6);
  value << load, 0.0, 3.0 - std::sqrt(kStringLength * kStringLength - off * off), pivot, 0.0, 3.0;
  return value;
}

TEST(SwingMotion, FollowsALoadBelowADrivenPivot) {
  const auto model = makeSwingMotion(TrajectoryKind::kPointAndPivot, {1e-3, 9.81});
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 1e-3);
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < 600; ++i) {
    const Time now = Time::fromSeconds(i * kFrame);
    Eigen::VectorXd value = drivenLoad(i * kFrame);
    for (double& number : value) {
      number += noise(random);
    }
    (void)model->update(now, value).hasValue();
    if (i >= 300) {
      const auto then = model->predict(now + 0.3);
      ASSERT_TRUE(then.hasValue());
      sum += (then->mean - drivenLoad(i * kFrame + 0.3).head(3)).head(2).squaredNorm();
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(sum / count), 0.01);
  EXPECT_NEAR(parameter(*model, "reach_m"), kStringLength, 5e-3);
}

TEST(SwingMotion, FindsItsWayAfterAJump) {
  const auto model = makeSwingMotion(TrajectoryKind::kPointAndPivot, {1e-3, 9.81});
  Eigen::VectorXd jump = Eigen::VectorXd::Zero(6);
  for (int i = 0; i < 300; ++i) {
    if (i == 250) {
      jump << 0.5, 0.5, 0.0, 0.5, 0.5, 0.0;
    }
    (void)model->update(Time::fromSeconds(i * kFrame), drivenLoad(i * kFrame) + jump).hasValue();
  }
  const auto then = model->predict(Time::fromSeconds(299 * kFrame + 0.1));
  ASSERT_TRUE(then.hasValue());
  EXPECT_LT((then->mean - drivenLoad(299 * kFrame + 0.1).head(3) - jump.head(3)).norm(), 0.03);
}

TEST(SwingMotion, RefusesWhatIsNoSampleAndSaysSo) {
  const auto model = makeSwingMotion(TrajectoryKind::kAngle, {});
  const Eigen::VectorXd angle = Eigen::VectorXd::Constant(1, 0.1);
  EXPECT_EQ(reasonOf(model->predict(Time())), "no measurement yet");
  EXPECT_TRUE(model->update(Time::fromSeconds(1.0), angle).hasValue());
  EXPECT_EQ(reasonOf(model->update(Time::fromSeconds(1.0), angle)), "late or duplicate time stamp");
  const Eigen::VectorXd bad =
      Eigen::VectorXd::Constant(1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(reasonOf(model->update(Time::fromSeconds(2.0), bad)), "not finite");
  EXPECT_EQ(model->name(), "spherical-pendulum");
}

TEST(SingerBank, TellsARestingPivotFromOneThatIsPushed) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  SingerBank bank(1e-3);
  EXPECT_FALSE(bank.likeliest().has_value());
  double p = 0.0, v = 0.0, a = 0.0;
  const double keep = std::exp(-kFrame / 0.3);
  for (int i = 0; i < 1500; ++i) {
    p += v * kFrame + 0.5 * a * kFrame * kFrame;
    v += a * kFrame;
    a = keep * a + 1.0 * std::sqrt(1.0 - keep * keep) * normal(random);
    const Eigen::Vector3d noise =
        1e-3 * Eigen::Vector3d::NullaryExpr([&] { return normal(random); });
    bank.update(Time::fromSeconds(i * kFrame), Eigen::Vector3d(p, 0.3, 1.0) + noise);
  }
  const SingerLaw law = *bank.likeliest();
  EXPECT_GE(law.sigma.x(), 0.3);
  EXPECT_LE(law.sigma.x(), 3.0);
  EXPECT_LE(law.sigma.tail<2>().maxCoeff(), 0.01);
  EXPECT_GE(law.memory_s, 0.1);
  EXPECT_LE(law.memory_s, 1.0);
}

TEST(SingerBank, TellsBadlyTimedSamplesByTheirSpeed) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  SingerBank bank(1e-4);
  for (int i = 0; i < 600; ++i) {
    const double taken = i * kFrame + 3e-3 * normal(random);
    bank.update(Time::fromSeconds(i * kFrame), Eigen::Vector3d(0.8 * taken, 0.0, 1.0));
  }
  EXPECT_EQ(bank.likeliest()->time_sigma_s, 3e-3);
}

}  // namespace
}  // namespace ringhook
