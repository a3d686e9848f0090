#include "stereo/epipolar.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "core/error.h"
#include "sample_views.h"

namespace ringhook {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(Epipolar, EveryProjectedPointFulfilsTheConstraint) {
  const auto views = test::pairOfViews(0.4, 0.15);
  const Eigen::Matrix3d F = fundamentalMatrix(views[0], views[1]);
  EXPECT_NEAR(F.determinant(), 0.0, 1e-15);
  for (const Vector3d& p : {Vector3d(0.2, 0, 1.3), Vector3d(-0.1, 0.2, 1.1), Vector3d(0, 0, 3)}) {
    const Vector2d left = *views[0].project(p);
    const Vector2d right = *views[1].project(p);
    EXPECT_NEAR(symmetricEpipolarDistance(F, left, right), 0.0, 1e-8);
    // One pixel off the line is one pixel of distance in that image.
    const Vector3d line = epipolarLineInRight(F, left);
    EXPECT_NEAR(line.dot((right + line.head<2>()).homogeneous()), 1.0, 1e-8);
    EXPECT_NEAR(epipolarLineInLeft(F, right).dot(left.homogeneous()), 0.0, 1e-8);
  }
}

TEST(Epipolar, EpipolesAreTheImagesOfTheOtherCentre) {
  const auto views = test::pairOfViews(0.4, 0.15);
  const Epipoles e = epipoles(fundamentalMatrix(views[0], views[1]));
  const Vector3d centre2 = views[1].cMc1.inverse().translation();
  EXPECT_LT((e.left.hnormalized() - *views[0].project(centre2)).norm(), 1e-5);
  const Vector3d centre1 = views[1].cMc1.translation();
  const Vector2d expected = 2500.0 * centre1.hnormalized() + Vector2d(1023.5, 1023.5);
  EXPECT_LT((e.right.hnormalized() - expected).norm(), 1e-5);
}

TEST(Epipolar, ParallelCamerasHaveRowsAsLines) {
  const auto views = test::pairOfViews(0.3, 0.0);
  const Vector3d line = epipolarLineInRight(fundamentalMatrix(views[0], views[1]), {700, 321});
  EXPECT_NEAR(line.x(), 0.0, 1e-12);
  EXPECT_NEAR(-line.z() / line.y(), 321.0, 1e-9);
}

TEST(Epipolar, EssentialMatrixHasTwoEqualSingularValues) {
  const Pose c2Mc1 = makePoseThetaU({-0.4, 0.02, 0.1}, {0.1, 0.3, -0.2});
  const Eigen::Matrix3d E = essentialMatrix(c2Mc1);
  const double b2 = c2Mc1.translation().squaredNorm();
  EXPECT_LT((E * E.transpose() * E - b2 * E).norm(), 1e-12);  // Faugeras' condition
  EXPECT_THROW((void)fundamentalMatrix(StereoRig{}), InputError);
}

}  // namespace
}  // namespace ringhook
