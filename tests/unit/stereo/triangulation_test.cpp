#include "stereo/triangulation.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <iostream>
#include <random>

#include "sample_views.h"

namespace ringhook {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSigma = 0.1;  // [px]

/// Cramer-Rao bound from numerical derivatives of the projection: independent of the code tested.
Matrix3d boundOf(const std::vector<PinholeView>& views, const Vector3d& p) {
  Matrix3d information = Matrix3d::Zero();
  for (const PinholeView& view : views) {
    Eigen::Matrix<double, 2, 3> J;
    for (int i = 0; i < 3; ++i) {
      const Vector3d h = 1e-6 * Vector3d::Unit(i);
      J.col(i) = (*view.project(p + h) - *view.project(p - h)) / 2e-6;
    }
    information += J.transpose() * J / (kSigma * kSigma);
  }
  return information.inverse();
}

struct PairSetup {
  const char* name;
  double baseline;
  double verge;
  Vector3d point;
};

const PairSetup kSetups[] = {{"parallel, B 0.3 m, Z 1.5 m", 0.3, 0.0, {0.15, 0.0, 1.5}},
                             {"verged, B 0.4 m, Z 1.3 m", 0.4, 0.1526, {0.03, 0.08, 1.3}}};

TEST(Triangulation, FindsExactPointsBothWays) {
  for (const PairSetup& setup : kSetups) {
    const auto views = test::pairOfViews(setup.baseline, setup.verge);
    for (const Vector3d& d :
         {Vector3d(0, 0, 0), Vector3d(0.1, -0.2, 0.3), Vector3d(-0.2, 0.1, -0.4)}) {
      const Vector3d p = setup.point + d;
      const auto a = triangulateMidpoint(views[0], views[1], *views[0].project(p),
                                         *views[1].project(p), kSigma);
      const auto b = triangulateOptimal(views[0], views[1], *views[0].project(p),
                                        *views[1].project(p), kSigma);
      ASSERT_TRUE(a);
      ASSERT_TRUE(b);
      EXPECT_LT((a->point_c1 - p).norm(), 1e-9);
      EXPECT_LT((b->point_c1 - p).norm(), 1e-9);
    }
  }
}

TEST(Triangulation, ReachesTheCramerRaoBoundAndKnowsItsCovariance) {
  constexpr int kTrials = 20000;
  for (const PairSetup& setup : kSetups) {
    const auto views = test::pairOfViews(setup.baseline, setup.verge);
    const Vector2d left = *views[0].project(setup.point);
    const Vector2d right = *views[1].project(setup.point);
    std::mt19937 random(4);
    std::normal_distribution<double> noise(0.0, kSigma);
    double optimal = 0.0;
    double midpoint = 0.0;
    double nees_optimal = 0.0;
    double nees_midpoint = 0.0;
    for (int i = 0; i < kTrials; ++i) {
      const Vector2d l = left + Vector2d(noise(random), noise(random));
      const Vector2d r = right + Vector2d(noise(random), noise(random));
      const auto a = triangulateMidpoint(views[0], views[1], l, r, kSigma);
      const auto b = triangulateOptimal(views[0], views[1], l, r, kSigma);
      ASSERT_TRUE(a);
      ASSERT_TRUE(b);
      const Vector3d ea = a->point_c1 - setup.point;
      const Vector3d eb = b->point_c1 - setup.point;
      midpoint += ea.squaredNorm() / kTrials;
      optimal += eb.squaredNorm() / kTrials;
      nees_midpoint += ea.dot(a->covariance.inverse() * ea) / kTrials;
      nees_optimal += eb.dot(b->covariance.inverse() * eb) / kTrials;
    }
    const double bound = std::sqrt(boundOf(views, setup.point).trace());
    std::cout << setup.name << ": bound " << bound * 1e3 << " mm, optimal/bound "
              << std::sqrt(optimal) / bound << ", midpoint/bound " << std::sqrt(midpoint) / bound
              << ", NEES optimal " << nees_optimal << ", midpoint " << nees_midpoint << " (3)\n";
    EXPECT_NEAR(std::sqrt(optimal) / bound, 1.0, 0.02);
    EXPECT_LT(std::sqrt(midpoint) / bound, 1.1);
    // Mean of 20000 values of chi-square(3): 3 +- 4 * sqrt(6 / 20000).
    EXPECT_NEAR(nees_optimal, 3.0, 0.07);
    EXPECT_NEAR(nees_midpoint, 3.0, 0.07);
  }
}

TEST(Triangulation, RefusesParallelRays) {
  const auto views = test::pairOfViews(0.3, 0.0);
  for (const auto triangulate : {triangulateMidpoint, triangulateOptimal}) {
    const auto point = triangulate(views[0], views[1], {1000, 1000}, {1000, 1000}, kSigma, {});
    ASSERT_FALSE(point);
    EXPECT_EQ(point.reason(), "parallel rays");
  }
}

TEST(Triangulation, RefusesPointsBehindACamera) {
  const auto views = test::pairOfViews(0.3, 0.0);
  for (const auto triangulate : {triangulateMidpoint, triangulateOptimal}) {
    const auto point = triangulate(views[0], views[1], {900, 1000}, {1100, 1000}, kSigma, {});
    ASSERT_FALSE(point);
    EXPECT_EQ(point.reason(), "point behind a camera");
  }
}

TEST(Triangulation, RefusesPixelsThatDoNotBelongTogether) {
  const auto views = test::pairOfViews(0.3, 0.0);
  for (const auto triangulate : {triangulateMidpoint, triangulateOptimal}) {
    const auto point = triangulate(views[0], views[1], {1100, 1000}, {700, 1012}, kSigma, {});
    ASSERT_FALSE(point);
    EXPECT_EQ(point.reason(), "residual too large");
    EXPECT_TRUE(triangulate(views[0], views[1], {1100, 1000}, {700, 1002}, kSigma, {}));
  }
}

}  // namespace
}  // namespace ringhook
