// The rigid fit of points, against made-up truth.

#include "calib/solve/point_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "core/error.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

struct MadePoints {
  Pose fMc1;
  std::vector<PointPair> points;
};

// Corners of a cube of 0.3 m about a metre in front of the camera; sigma along the camera's axes.
MadePoints cube(unsigned seed, const Vector3d& sigma_c) {
  MadePoints made;
  made.fMc1 = makePoseThetaU({1.75, 0.2, 0.7}, {1.2, -1.1, 0.4});
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d p(0.3 * (corner & 1), 0.15 * (corner & 2), 1.0 + 0.075 * (corner & 4));
    const Vector3d noise = sigma_c.cwiseProduct(Vector3d(normal(dice), normal(dice), normal(dice)));
    made.points.push_back({"corner " + std::to_string(corner), made.fMc1 * p, p + noise});
  }
  return made;
}

TEST(PointFit, IsExactWithoutNoise) {
  const MadePoints made = cube(1, Vector3d::Zero());
  const PointFit fit = fitPoints(made.points);
  EXPECT_LT((fit.fMc1.matrix() - made.fMc1.matrix()).norm(), 1e-12);
  EXPECT_LT(fit.residual_m, 1e-12);
  EXPECT_EQ(fit.verdict.grade, Grade::kGood) << fit.verdict.sentence;
}

TEST(PointFit, ResidualIsWhatTheNoiseLeaves) {
  // 24 coordinates, 6 unknowns: RMS distance sqrt(3) sigma sqrt(18 / 24).
  double sum = 0.0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const PointFit fit = fitPoints(cube(seed, Vector3d::Constant(0.0002)).points);
    sum += fit.residual_m * fit.residual_m / 200.0;
  }
  EXPECT_NEAR(std::sqrt(sum), 0.0002 * std::sqrt(3.0 * 18.0 / 24.0), 0.00001);
}

TEST(PointFit, CovarianceIsHonestAboutDepth) {
  double sum = 0.0;
  const int sets = 300;
  double depth = 0.0;
  for (unsigned seed = 0; seed < sets; ++seed) {
    const MadePoints made = cube(seed, {0.0001, 0.0001, 0.0005});
    const PointFit fit = fitPoints(made.points);
    const Twist e = logSe3(fit.fMc1.inverse() * made.fMc1);
    sum += e.dot(fit.covariance.ldlt().solve(e)) / sets;
    depth += fit.axis_rms_m.z() / fit.axis_rms_m.x() / sets;
  }
  // Six unknowns; the noise along each axis is itself estimated from eight points less two, so that
  // squares follow Student's law with six degrees, whose variance is 6 / (6 - 2).
  EXPECT_NEAR(sum, 6.0 * 1.5, 1.5);
  EXPECT_GT(depth, 2.0);
}

TEST(PointFit, NamesOneWrongPoint) {
  MadePoints made = cube(3, Vector3d::Constant(0.0002));
  made.points[5].point_c.y() += 0.01;
  const PointFit fit = fitPoints(made.points);
  ASSERT_EQ(fit.rejected.size(), 1U);
  EXPECT_EQ(fit.rejected[0].name, "corner 5");
  EXPECT_LT((fit.fMc1.translation() - made.fMc1.translation()).norm(), 0.002);
  EXPECT_NE(fit.verdict.grade, Grade::kPoor) << fit.verdict.sentence;
}

TEST(PointFit, HeldOutErrorIsLargerThanTheResidual) {
  const PointFit fit = fitPoints(cube(4, Vector3d::Constant(0.0002)).points);
  EXPECT_GT(fit.heldout_m, fit.residual_m);
}

TEST(PointFit, NoticesAWrongScaleAndAMirror) {
  MadePoints made = cube(5, Vector3d::Constant(0.0002));
  for (PointPair& p : made.points) {
    p.point_c *= 1.05;
  }
  const PointFit scaled = fitPoints(made.points);
  EXPECT_EQ(scaled.verdict.grade, Grade::kPoor);
  EXPECT_THAT(scaled.verdict.sentence, HasSubstr("scaled by 0.95"));
  made = cube(5, Vector3d::Constant(0.0002));
  for (PointPair& p : made.points) {
    p.point_c.y() = -p.point_c.y();
  }
  EXPECT_THAT(fitPoints(made.points).verdict.sentence, HasSubstr("mirror"));
}

TEST(PointFit, RefusesRowsThatDoNotBelongTogether) {
  MadePoints made = cube(6, Vector3d::Constant(0.0002));
  std::swap(made.points[0].point_c, made.points[3].point_c);
  std::swap(made.points[1].point_c, made.points[6].point_c);
  const PointFit fit = fitPoints(made.points);
  EXPECT_EQ(fit.verdict.grade, Grade::kPoor) << fit.verdict.sentence;
}

TEST(PointFit, RefusesFewPointsAndPointsOnALine) {
  MadePoints made = cube(7, Vector3d::Zero());
  for (std::size_t i = 0; i < made.points.size(); ++i) {
    made.points[i].point_c = made.points[i].point_f = Vector3d(0.1 * static_cast<double>(i), 0, 1);
  }
  EXPECT_THROW(fitPoints(made.points), InputError);
  made.points.resize(4);
  EXPECT_THROW(fitPoints(made.points), InputError);
}

}  // namespace
}  // namespace ringhook
