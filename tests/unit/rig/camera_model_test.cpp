#include "rig/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>

#include "sample_rig.h"

namespace ringhook {
namespace {

cv::Mat toCv(const Eigen::MatrixXd& m) {
  cv::Mat out(static_cast<int>(m.rows()), static_cast<int>(m.cols()), CV_64F);
  for (int i = 0; i < out.rows * out.cols; ++i) {
    out.at<double>(i / out.cols, i % out.cols) = m(i / out.cols, i % out.cols);
  }
  return out;
}

class EveryLensModel : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Coefficients, EveryLensModel, testing::Values(0, 4, 5, 8));

TEST_P(EveryLensModel, ProjectsAsOpenCvDoes) {
  const CameraModel camera = test::sampleCamera(2048, GetParam());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-0.4, 0.4);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d x(place(random), place(random));
    std::vector<cv::Point2d> expected;
    cv::projectPoints(std::vector<cv::Point3d>{{x.x(), x.y(), 1.0}}, cv::Vec3d(), cv::Vec3d(),
                      toCv(camera.K), toCv(camera.distortion.transpose()), expected);
    const Eigen::Vector2d pixel = projectNormalised(camera, x);
    EXPECT_NEAR(pixel.x(), expected[0].x, 1e-9);
    EXPECT_NEAR(pixel.y(), expected[0].y, 1e-9);
  }
}

TEST_P(EveryLensModel, ComesBackFromPixelToRay) {
  const CameraModel camera = test::sampleCamera(2048, GetParam());
  for (int u = 0; u < 2048; u += 93) {
    for (int v = 0; v < 2000; v += 91) {
      const auto ray = undistortPixel(camera, {u, v});
      ASSERT_TRUE(ray);
      EXPECT_LT((projectNormalised(camera, *ray) - Eigen::Vector2d(u, v)).norm(), 1e-8);
    }
  }
}

TEST_P(EveryLensModel, HasTheDerivativeOfItsLaw) {
  const CameraModel camera = test::sampleCamera(2048, GetParam());
  const Eigen::Vector2d x(0.21, -0.34);
  Eigen::Matrix2d jacobian;
  (void)distortNormalised(camera, x, &jacobian);
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d h = 1e-6 * Eigen::Vector2d::Unit(i);
    const Eigen::Vector2d slope =
        (distortNormalised(camera, x + h) - distortNormalised(camera, x - h)) / 2e-6;
    EXPECT_LT((jacobian.col(i) - slope).norm(), 1e-8);
  }
}

TEST(LensModel, RefusesPixelsBeyondTheFold) {
  CameraModel camera = test::sampleCamera(2048, 4);
  camera.distortion << -0.5, 0.0, 0.0, 0.0;  // r - 0.5 r^3 turns at r = sqrt(2/3)
  EXPECT_NEAR(foldRadius(camera), std::sqrt(2.0 / 3.0), 1e-9);
  const double edge_px = camera.K(0, 0) * std::sqrt(2.0 / 3.0) * 2.0 / 3.0;
  const Eigen::Vector2d centre(camera.K(0, 2), camera.K(1, 2));
  EXPECT_TRUE(undistortPixel(camera, centre + Eigen::Vector2d(edge_px - 1.0, 0)));
  const auto outside = undistortPixel(camera, centre + Eigen::Vector2d(edge_px + 1.0, 0));
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.reason(), "pixel beyond the lens model");
}

}  // namespace
}  // namespace ringhook
