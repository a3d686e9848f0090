#include "stereo/joint_pose.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <iostream>
#include <random>

#include "sample_views.h"
#include "stereo/joint_residuals.h"
#include "stereo/plate_pose.h"

namespace ringhook {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const std::vector<PinholeView> kViews = test::pairOfViews(0.4, 0.1526);

/// Inverse of the Cramer-Rao information of all corners, by numerical derivatives.
Covariance6 boundOf(const std::vector<PinholeView>& views, const Pose& c1Mo, double sigma_px) {
  Covariance6 information = Covariance6::Zero();
  for (const PinholeView& view : views) {
    for (const Vector3d& p : test::plateCorners()) {
      Eigen::Matrix<double, 2, 6> J;
      for (int i = 0; i < 6; ++i) {
        const Twist h = 1e-6 * Twist::Unit(i);
        J.col(i) =
            (*view.project(c1Mo * expSe3(h) * p) - *view.project(c1Mo * expSe3(-h) * p)) / 2e-6;
      }
      information += J.transpose() * J / (sigma_px * sigma_px);
    }
  }
  return information.inverse();
}

/// Edge sites along a 12 mm x 6 mm bar of 450 mm; each edge's sites share part of their error.
HookView seenBar(const Pose& c1Mo, double sigma_px, double shared, std::mt19937& random,
                 double noise_sigmas = 1.0) {
  std::normal_distribution<double> unit(0.0, 1.0);
  const auto noise = [&](std::mt19937& r) { return noise_sigmas * sigma_px * unit(r); };
  HookView view;
  view.c1Mo_start = c1Mo;
  for (const PinholeView& camera : kViews) {
    CameraFeatures features{camera, {}, {}};
    const Vector3d ends[] = {{-0.006, 0, 0},    {0.006, 0, 0},       {0.006, 0.45, 0},
                             {-0.006, 0.45, 0}, {-0.006, 0.2, 0.03}, {0.006, 0.25, 0.03}};
    for (const auto& [a, b] : {std::pair{0, 3}, {1, 2}, {0, 1}, {3, 2}, {4, 5}}) {
      const Vector2d pa = *camera.project(c1Mo * ends[a]);
      const Vector2d pb = *camera.project(c1Mo * ends[b]);
      const Vector2d across = Vector2d(pa.y() - pb.y(), pb.x() - pa.x()).normalized();
      const double common = std::sqrt(shared) * noise(random);
      for (int i = 0; i < 60; ++i) {
        const double own = std::sqrt(1.0 - shared) * noise(random);
        features.edges.push_back({ends[a], ends[b],
                                  pa + (pb - pa) * (i + 0.5) / 60.0 + across * (common + own),
                                  sigma_px});
      }
    }
    view.cameras.push_back(features);
  }
  return view;
}

double nees(const HookFix& fix, const Pose& truth) {
  const Twist d = logSe3(truth.inverse() * fix.c1Mo);
  return d.dot(fix.covariance.inverse() * d);
}

TEST(JointPose, JacobiansAreTheDerivativesOfTheResiduals) {
  std::mt19937 random(10);
  HookView view = test::seenPlate(kViews, test::samplePose(), 2.0, random);
  view.cameras[0].edges = seenBar(test::samplePose(), 2.0, 0.0, random).cameras[0].edges;
  ResidualRows at;
  ResidualRows plus;
  ResidualRows minus;
  ASSERT_TRUE(evaluateRows(view, test::samplePose(), at));
  for (int i = 0; i < 6; ++i) {
    const Twist h = 1e-6 * Twist::Unit(i);
    ASSERT_TRUE(evaluateRows(view, test::samplePose() * expSe3(h), plus));
    ASSERT_TRUE(evaluateRows(view, test::samplePose() * expSe3(-h), minus));
    for (std::size_t k = 0; k < at.rows.size(); ++k) {
      const double slope = (plus.rows[k].r_px - minus.rows[k].r_px) / 2e-6;
      EXPECT_NEAR(at.rows[k].J[i], slope, 1e-3 + 1e-6 * std::abs(slope));
    }
  }
}

TEST(JointPose, FindsTheExactPoseFromARoughStart) {
  std::mt19937 random(11);
  for (HookView view : {test::seenPlate(kViews, test::samplePose(), 0.0, random),
                        seenBar(test::samplePose(), 0.3, 0.0, random, 0.0)}) {
    view.c1Mo_start = test::samplePose() * makePoseThetaU({0.01, -0.01, 0.02}, {0.05, -0.04, 0.03});
    const auto fix = fixFromView(view);
    ASSERT_TRUE(fix) << fix.reason();
    EXPECT_LT((fix->c1Mo.translation() - test::samplePose().translation()).norm(), 1e-8);
    EXPECT_TRUE(fix->c1Mo.isApprox(test::samplePose(), 1e-8));
  }
}

TEST(JointPose, OfEightCornersReachesTheBoundWithAConsistentCovariance) {
  constexpr int kTrials = 4000;
  std::mt19937 random(12);
  const Pose truth = test::samplePose();
  double joint = 0.0;
  double report = 0.0;
  double single = 0.0;
  double mean_nees = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    const HookView view = test::seenPlate(kViews, truth, 0.1, random);
    const auto fix = fixFromView(view);
    ASSERT_TRUE(fix) << fix.reason();
    joint += (fix->c1Mo.translation() - truth.translation()).squaredNorm() / kTrials;
    mean_nees += nees(*fix, truth) / kTrials;
    const auto plane = platePoseFromPoints(view);
    ASSERT_TRUE(plane) << plane.reason();
    report += (plane->translation() - truth.translation()).squaredNorm() / kTrials;
    const auto one = singleViewFix(view, 0);
    ASSERT_TRUE(one) << one.reason();
    single += (one->c1Mo.translation() - truth.translation()).squaredNorm() / kTrials;
  }
  const double bound = std::sqrt(boundOf(kViews, truth, 0.1).topLeftCorner<3, 3>().trace());
  std::cout << "bound " << bound * 1e3 << " mm; RMS over bound: joint " << std::sqrt(joint) / bound
            << ", midpoints and plane " << std::sqrt(report) / bound << ", single view "
            << std::sqrt(single) / bound << "; NEES " << mean_nees << " (6)\n";
  EXPECT_NEAR(std::sqrt(joint) / bound, 1.0, 0.05);
  EXPECT_NEAR(mean_nees, 6.0, 0.25);  // 4 * sqrt(12 / 4000) = 0.22, and the rare inflation
}

TEST(JointPose, OfCorrelatedEdgesIsNotOverconfident) {
  constexpr int kTrials = 300;
  std::mt19937 random(13);
  double mean_nees = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    const auto fix = fixFromView(seenBar(test::samplePose(), 0.3, 0.05, random));
    ASSERT_TRUE(fix) << fix.reason();
    mean_nees += nees(*fix, test::samplePose()) / kTrials;
  }
  std::cout << "NEES of edges with correlation 0.05: " << mean_nees << " (6)\n";
  EXPECT_LT(mean_nees, 6.8);
  EXPECT_GT(mean_nees, 2.0);
}

TEST(JointPose, ForgetsOutlyingEdgeSites) {
  std::mt19937 random(14);
  HookView view = seenBar(test::samplePose(), 0.1, 0.0, random);
  for (CameraFeatures& camera : view.cameras) {
    for (std::size_t i = 0; i < camera.edges.size(); i += 5) {
      camera.edges[i].pixel += Vector2d(15.0, 9.0);
    }
  }
  const auto fix = fixFromView(view);
  ASSERT_TRUE(fix) << fix.reason();
  EXPECT_LT((fix->c1Mo.translation() - test::samplePose().translation()).norm(), 5e-4);
  EXPECT_LT(fix->rms_px, 0.15);
}

TEST(JointPose, GrowsItsCovarianceWhenResidualsExceedSigma) {
  std::mt19937 random(15);
  const auto good = fixFromView(test::seenPlate(kViews, test::samplePose(), 0.1, random));
  const auto bad = fixFromView(test::seenPlate(kViews, test::samplePose(), 0.2, random));
  ASSERT_TRUE(good);
  ASSERT_TRUE(bad);
  EXPECT_GT(bad->covariance.trace(), 2.0 * good->covariance.trace());
}

TEST(JointPose, RefusesWithAReason) {
  std::mt19937 random(16);
  const HookView good = test::seenPlate(kViews, test::samplePose(), 0.1, random);
  HookView view = good;
  view.cameras.clear();
  EXPECT_EQ(fixFromView(view).reason(), "no features");
  view = good;
  view.cameras.pop_back();
  view.cameras[0].corners.resize(2);
  EXPECT_EQ(fixFromView(view).reason(), "too few features");
  view = good;
  view.c1Mo_start.translation().z() = -1.0;
  EXPECT_EQ(fixFromView(view).reason(), "behind camera");
  view = good;
  for (CornerFeature& corner : view.cameras[1].corners) {
    corner.pixel.y() += 20.0;
  }
  EXPECT_EQ(fixFromView(view).reason(), "residual too large");
  // Sites of one straight edge never tell the motion along it.
  view = seenBar(test::samplePose(), 0.1, 0.0, random);
  for (CameraFeatures& camera : view.cameras) {
    camera.edges.resize(60);
  }
  EXPECT_EQ(fixFromView(view).reason(), "too few features");
}

}  // namespace
}  // namespace ringhook
