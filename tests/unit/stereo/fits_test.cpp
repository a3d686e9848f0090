#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "core/shortest_turn.h"
#include "sample_views.h"
#include "stereo/plane_fit.h"
#include "stereo/plate_pose.h"
#include "stereo/rigid_fit.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;

TEST(PlaneFit, FindsTheNormalOfATiltedPlane) {
  const Vector3d normal = Vector3d(0.3, -0.5, 0.8).normalized();
  std::vector<Vector3d> points;
  for (const Vector3d& p : test::plateCorners()) {
    points.push_back(shortestTurn(Vector3d::UnitZ(), normal) * p + Vector3d(1, 2, 3));
  }
  const auto plane = fitPlane(points);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(std::abs(plane->normal().dot(normal)), 1.0, 1e-12);
  EXPECT_LT(plane->rms, 1e-12);
  EXPECT_NEAR(plane->axes.determinant(), 1.0, 1e-12);
}

TEST(PlaneFit, RefusesLinesAndTooFewPoints) {
  EXPECT_EQ(fitPlane({{0, 0, 0}, {1, 0, 0}}).reason(), "fewer than three points");
  EXPECT_EQ(fitPlane({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}).reason(), "points on one line");
}

TEST(RigidFit, RecoversAMotionAndNeverReflects) {
  const Pose aMb = makePoseThetaU({0.1, -0.2, 0.3}, {1.0, -2.0, 0.5});
  std::vector<Vector3d> a;
  const std::vector<Vector3d> b = test::plateCorners();  // flat: a reflection would fit as well
  for (const Vector3d& p : b) {
    a.push_back(aMb * p);
  }
  const auto fit = fitRigid(a, b);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->aMb.isApprox(aMb, 1e-12));
  EXPECT_NEAR(fit->aMb.linear().determinant(), 1.0, 1e-12);
  // A mirrored body: the best rotation, with an honest residual.
  const std::vector<Vector3d> body = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {1, 1, 1}};
  std::vector<Vector3d> mirrored = body;
  for (Vector3d& p : mirrored) {
    p.x() = -p.x();
  }
  const auto turned = fitRigid(mirrored, body);
  ASSERT_TRUE(turned);
  EXPECT_NEAR(turned->aMb.linear().determinant(), 1.0, 1e-12);
  EXPECT_GT(turned->rms, 0.1);
}

TEST(RigidFit, RefusesWhatLeavesTheRotationOpen) {
  EXPECT_EQ(fitRigid({{0, 0, 0}}, {}).reason(), "numbers of points differ");
  const std::vector<Vector3d> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(fitRigid(line, line).reason(), "points on one line");
}

TEST(PlatePose, TheReportsWayFindsTheExactPose) {
  std::mt19937 random(5);
  const auto views = test::pairOfViews(0.4, 0.1526);
  HookView view = test::seenPlate(views, test::samplePose(), 0.0, random);
  const auto c1Mo = platePoseFromPoints(view);
  ASSERT_TRUE(c1Mo);
  EXPECT_TRUE(c1Mo->isApprox(test::samplePose(), 1e-7));
  view.cameras.pop_back();
  EXPECT_EQ(platePoseFromPoints(view).reason(), "needs two cameras");
}

TEST(PlanarStartPose, ChoosesTheTruePoseInOneAndTwoViews) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> tilt(-0.7, 0.7);
  const auto views = test::pairOfViews(0.4, 0.1526);
  for (int i = 0; i < 50; ++i) {
    const Pose c1Mo =
        makePoseThetaU({0.17, 0.05, 1.3}, {0.3 + tilt(random), tilt(random), tilt(random)});
    const HookView view = test::seenPlate(views, c1Mo, 0.0, random);
    const auto two = planarStartPose(view.cameras);
    ASSERT_TRUE(two);
    EXPECT_TRUE(two->isApprox(c1Mo, 1e-6));
    const auto one = planarStartPose({view.cameras[1]});
    ASSERT_TRUE(one);
    EXPECT_TRUE(one->isApprox(c1Mo, 1e-5));
  }
}

TEST(PlanarStartPose, WithNoiseTwoViewsNeverMistakeTheMirroredPose) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> tilt(-0.6, 0.6);
  const auto views = test::pairOfViews(0.4, 0.1526);
  for (int i = 0; i < 200; ++i) {
    const Pose c1Mo = makePoseThetaU({0.17, 0.05, 1.3}, {tilt(random), tilt(random), 0.0});
    const auto start = planarStartPose(test::seenPlate(views, c1Mo, 0.1, random).cameras);
    ASSERT_TRUE(start);
    EXPECT_LT(thetaU(start->linear().transpose() * c1Mo.linear()).norm(), 0.05);
  }
}

TEST(PlanarStartPose, RefusesSolidAndTooFewCorners) {
  std::mt19937 random(8);
  HookView view = test::seenPlate(test::pairOfViews(0.4, 0.1526), test::samplePose(), 0.0, random);
  view.cameras.pop_back();
  view.cameras[0].corners[2].point_o.z() = 0.03;
  EXPECT_EQ(planarStartPose(view.cameras).reason(), "corners not in one plane");
  view.cameras[0].corners.resize(3);
  EXPECT_EQ(planarStartPose(view.cameras).reason(), "too few corners");
}

TEST(PlanarStartPose, RefusesAPlateSeenEdgeOn) {
  std::mt19937 random(9);
  HookView view = test::seenPlate(test::pairOfViews(0.4, 0.1526), test::samplePose(), 0.0, random);
  view.cameras.pop_back();
  for (CornerFeature& corner : view.cameras[0].corners) {
    corner.pixel.y() = 300.0 + 0.25 * corner.pixel.x();
  }
  EXPECT_EQ(planarStartPose(view.cameras).reason(), "corners seen on one line");
}

}  // namespace
}  // namespace ringhook
