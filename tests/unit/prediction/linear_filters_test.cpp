#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "outcome_text.h"
#include "prediction/chi_square.h"
#include "prediction/constant_acceleration.h"
#include "prediction/linear_kalman.h"

namespace ringhook {
namespace {

using Matrix1 = Eigen::Matrix<double, 1, 1>;

Gaussian<2> someBelief() {
  Gaussian<2> belief;
  belief.mean << 1.0, -2.0;
  belief.covariance << 2.0, 0.3, 0.3, 1.0;
  return belief;
}

// Equation 3.13 as the report prints it, and the least-squares form of the same estimate.
TEST(LinearKalman, EqualsTheReportsUpdateAndWeightedLeastSquares) {
  const Gaussian<2> prior = someBelief();
  Eigen::Matrix2d C;
  C << 1.0, 0.5, 0.0, 2.0;
  Eigen::Matrix2d R;
  R << 0.4, 0.1, 0.1, 0.2;
  const Eigen::Vector2d y(0.3, 0.7);
  const auto got = kalmanCorrect<2, 2>(prior, y, C, R);
  const Eigen::Matrix2d S = C * prior.covariance * C.transpose() + R;
  const Eigen::Matrix2d K = prior.covariance * C.transpose() * S.inverse();
  const Eigen::Matrix2d printed = (Eigen::Matrix2d::Identity() - K * C) * prior.covariance;
  EXPECT_TRUE(got.belief.covariance.isApprox(printed, 1e-12));
  const Eigen::Matrix2d information = prior.covariance.inverse() + C.transpose() * R.inverse() * C;
  const Eigen::Vector2d best = information.inverse() * (prior.covariance.inverse() * prior.mean +
                                                        C.transpose() * R.inverse() * y);
  EXPECT_TRUE(got.belief.mean.isApprox(best, 1e-12));
  EXPECT_TRUE(got.innovation.isApprox(y - C * prior.mean, 1e-15));
  EXPECT_TRUE(got.innovation_covariance.isApprox(S, 1e-15));
  EXPECT_NEAR(got.nis, got.innovation.dot(S.inverse() * got.innovation), 1e-12);
}

// Limits 3.9 to 3.12.
TEST(LinearKalman, TrustsASureMeasurementAndASurePrediction) {
  const Eigen::RowVector2d C(1.0, 0.0);
  const auto sure_y = kalmanCorrect<2, 1>(someBelief(), Matrix1(5.0), C, Matrix1(1e-14));
  EXPECT_NEAR(sure_y.belief.mean.x(), 5.0, 1e-9);
  Gaussian<2> sure_x = someBelief();
  sure_x.covariance *= 1e-14;
  const auto kept = kalmanCorrect<2, 1>(sure_x, Matrix1(5.0), C, Matrix1(1.0));
  EXPECT_TRUE(kept.belief.mean.isApprox(sure_x.mean, 1e-9));
}

// Equation 5.5, the report's matrix for dt = 1.
TEST(ConstantAcceleration, HasTheReportsMatrixAtOneSecond) {
  Matrix9 printed = Matrix9::Identity();
  for (int i = 0; i < 3; ++i) {
    printed(i, i + 3) = printed(i + 3, i + 6) = 1.0;
    printed(i, i + 6) = 0.5;
  }
  EXPECT_EQ(accelerationTransition(1.0), printed);
}

TEST(ConstantAcceleration, StepsComposeInTransitionAndNoise) {
  const Matrix9 a = accelerationTransition(0.03);
  const Matrix9 b = accelerationTransition(0.05);
  EXPECT_TRUE((b * a).isApprox(accelerationTransition(0.08), 1e-14));
  EXPECT_TRUE((a * accelerationTransition(-0.03)).isIdentity(1e-14));
  const Matrix9 two = b * jerkNoise(0.03, 2.0) * b.transpose() + jerkNoise(0.05, 2.0);
  EXPECT_TRUE(two.isApprox(jerkNoise(0.08, 2.0), 1e-12));
  const Matrix9 there_and_back = accelerationTransition(-0.05) * jerkNoise(0.05, 2.0) *
                                 accelerationTransition(-0.05).transpose();
  EXPECT_TRUE(there_and_back.isApprox(jerkNoise(-0.05, 2.0), 1e-12));
}

// A point driven by white jerk, the filter's own law: the mean of many NIS lies in its band.
TEST(ConstantAcceleration, IsConsistentOnAPointOfItsOwnLaw) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> gap(0.01, 0.04);
  ConstantAccelerationOptions options;
  options.jerk_density = 0.5;
  ConstantAccelerationFilter filter(options);
  Vector9 x = Vector9::Zero();
  double t = 0.0;
  double sum = 0.0;
  constexpr int kSteps = 2000;
  for (int i = 0; i <= kSteps; ++i) {
    const double dt = gap(random);
    t += dt;
    const Matrix9 root = Matrix9(jerkNoise(dt, 0.5).llt().matrixL());
    x = accelerationTransition(dt) * x +
        root * Vector9::NullaryExpr([&] { return normal(random); });
    const Eigen::Vector3d y =
        x.head<3>() + 1e-3 * Eigen::Vector3d::NullaryExpr([&] { return normal(random); });
    const auto update = filter.update(Time::fromSeconds(t), y, 1e-6 * Eigen::Matrix3d::Identity());
    ASSERT_TRUE(update);
    sum += i == 0 ? 0.0 : update->nis;
  }
  EXPECT_GT(sum, chiSquareQuantile(0.025, 3.0 * kSteps));
  EXPECT_LT(sum, chiSquareQuantile(0.975, 3.0 * kSteps));
}

TEST(ConstantAcceleration, FindsTheBeltSpeedWithTheReportsNoise) {
  ConstantAccelerationOptions options;
  options.fixed_noise = reportNoise(1e-5, 1e-4, 1e-4);
  ConstantAccelerationFilter filter(options);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 1e-3);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p(0.42 + noise(random), 0.03 * i / 30.0 + noise(random), noise(random));
    ASSERT_TRUE(filter.update(Time::fromSeconds(i / 30.0), p, 1e-6 * Eigen::Matrix3d::Identity()));
  }
  const auto ahead = filter.predict(Time::fromSeconds(299 / 30.0 + 0.1));
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->mean(4), 0.03, 0.002);  // the report's belt: 30 mm/s along y
  EXPECT_NEAR(ahead->mean(1), 0.03 * (299 / 30.0 + 0.1), 0.001);
}

TEST(ConstantAcceleration, RefusesWithAReason) {
  ConstantAccelerationOptions options;
  options.gate_probability = 0.999;
  ConstantAccelerationFilter filter(options);
  const Eigen::Matrix3d R = 1e-6 * Eigen::Matrix3d::Identity();
  EXPECT_EQ(reasonOf(filter.predict(Time())), "no measurement yet");
  EXPECT_EQ(reasonOf(filter.update(Time(), Eigen::Vector3d(NAN, 0, 0), R)), "not finite");
  ASSERT_TRUE(filter.update(Time::fromSeconds(1.0), Eigen::Vector3d::Zero(), R));
  EXPECT_EQ(reasonOf(filter.update(Time::fromSeconds(0.9), Eigen::Vector3d::Zero(), R)),
            "late or duplicate time stamp");
  EXPECT_EQ(reasonOf(filter.update(Time::fromSeconds(1.02), Eigen::Vector3d(1, 0, 0), R)),
            "outside the gate");
}

}  // namespace
}  // namespace ringhook
