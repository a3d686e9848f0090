// Corners of four squares in drawn pictures, against the drawing, the Cramer-Rao bound and OpenCV.

#include "calib/solve/saddle_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <random>

#include "calib/solve/cv_image.h"

namespace ringhook {
namespace {

using Eigen::Vector2d;

constexpr int kSize = 61;
constexpr int kHalf = 12;  // of the window
constexpr double kBlur_px = 0.8;
constexpr double kDark = 60.0;
constexpr double kLight = 190.0;

struct Drawn {
  Vector2d corner{30.3, 29.6};
  double angle1 = 0.2;  // of the edges' normals
  double angle2 = 1.5;
  double slope = 0.0;        // light falls to one side: grey levels a pixel
  double lens_response = 1;  // exponent
};

// Lightness in [0, 1] under a Gaussian blur, summed over points of the sharp pattern: the drawing
// shares no formula with the fit.
double lightness(const Drawn& drawn, const Vector2d& at) {
  const Vector2d n1(std::cos(drawn.angle1), std::sin(drawn.angle1));
  const Vector2d n2(std::cos(drawn.angle2), std::sin(drawn.angle2));
  double sum = 0.0;
  double weights = 0.0;
  constexpr int kPoints = 31;  // a side
  for (int j = 0; j < kPoints; ++j) {
    for (int i = 0; i < kPoints; ++i) {
      const Vector2d from_at = 0.2 * Vector2d(i - kPoints / 2, j - kPoints / 2);
      const double weight = std::exp(-0.5 * from_at.squaredNorm() / (kBlur_px * kBlur_px));
      const Vector2d r = at + from_at - drawn.corner;
      const double side = n1.dot(r) * n2.dot(r);
      sum += side > 0.0 ? weight : 0.0;
      weights += weight;
    }
  }
  return sum / weights;
}

std::vector<double> greys(const Drawn& drawn) {
  std::vector<double> all;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double light = std::pow(lightness(drawn, Vector2d(x, y)), drawn.lens_response);
      all.push_back(kDark + (kLight - kDark) * light + drawn.slope * (x - 30));
    }
  }
  return all;
}

GrayImage exposed(const std::vector<double>& greys, double noise, std::mt19937_64& dice) {
  std::normal_distribution<double> normal;
  GrayImage image(kSize, kSize);
  std::transform(greys.begin(), greys.end(), image.pixels.begin(), [&](double grey) {
    const long level = std::lround(grey + noise * normal(dice));
    return static_cast<std::uint8_t>(std::clamp(level, 0L, 255L));
  });
  return image;
}

GrayImage draw(const Drawn& drawn) {
  std::mt19937_64 dice(1);
  return exposed(greys(drawn), 0.0, dice);
}

Vector2d byOpenCv(const GrayImage& image, const Vector2d& start) {
  std::vector<cv::Point2f> one{
      cv::Point2f(static_cast<float>(start.x()), static_cast<float>(start.y()))};
  cv::cornerSubPix(matOf(image), one, cv::Size(kHalf, kHalf), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-4));
  return {one[0].x, one[0].y};
}

// Inverse Fisher information of the corner alone, from differences of drawn pictures [px^2]. What
// is not known besides can only make it larger.
Eigen::Matrix2d bound(const Drawn& drawn, double noise) {
  std::array<std::vector<double>, 4> moved;
  for (std::size_t i = 0; i < 4; ++i) {
    Drawn other = drawn;
    other.corner[static_cast<int>(i / 2)] += i % 2 == 0 ? -0.25 : 0.25;
    moved.at(i) = greys(other);
  }
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (int y = 30 - kHalf; y <= 30 + kHalf; ++y) {
    for (int x = 30 - kHalf; x <= 30 + kHalf; ++x) {
      const auto i = static_cast<std::size_t>(y * kSize + x);
      const Vector2d slope(moved[1][i] - moved[0][i], moved[3][i] - moved[2][i]);
      information += slope * slope.transpose() / (0.25 * noise * noise);
    }
  }
  return information.inverse();
}

TEST(SaddleFit, ComesNearTheCramerRaoBoundAndFarBelowOpenCv) {
  constexpr double kNoise = 3.0;  // grey levels
  const Drawn drawn;
  const std::vector<double> clean = greys(drawn);
  std::mt19937_64 dice(5);
  double ours = 0.0;
  double theirs = 0.0;
  const int pictures = 200;
  for (int i = 0; i < pictures; ++i) {
    const GrayImage image = exposed(clean, kNoise, dice);
    const auto corner = fitSaddle(image, {30.0, 30.0}, kHalf);
    ASSERT_TRUE(corner.has_value());
    ours += (*corner - drawn.corner).squaredNorm() / pictures;
    theirs += (byOpenCv(image, {30.0, 30.0}) - drawn.corner).squaredNorm() / pictures;
  }
  const double least = bound(drawn, kNoise).trace();
  RecordProperty("ours_over_bound", std::to_string(ours / least));
  RecordProperty("opencv_over_bound", std::to_string(theirs / least));
  EXPECT_LT(ours, 1.4 * least);
  EXPECT_GT(ours, 0.7 * least);
  EXPECT_LT(ours, 0.2 * theirs);
}

TEST(SaddleFit, IsNotMovedByShadingResponseOrSkew) {
  const auto off = [](const std::function<void(Drawn&)>& change) {
    Drawn drawn;
    change(drawn);
    const auto corner = fitSaddle(draw(drawn), {30.0, 30.0}, kHalf);
    return corner ? (*corner - drawn.corner).norm() : HUGE_VAL;
  };
  EXPECT_LT(off([](Drawn&) {}), 0.01);
  EXPECT_LT(off([](Drawn& d) { d.slope = 0.8; }), 0.01);
  EXPECT_LT(off([](Drawn& d) { d.lens_response = 0.6; }), 0.01);
  EXPECT_LT(off([](Drawn& d) { d.angle2 = 0.9; }), 0.01);
  EXPECT_LT(off([](Drawn& d) { d.angle1 = 2.9; }), 0.01);
  EXPECT_LT(off([](Drawn& d) { std::swap(d.angle1, d.angle2); }), 0.01);
}

TEST(SaddleFit, FindsACornerBesideTheImagesBorder) {
  Drawn drawn;
  drawn.corner = {3.2, 30.4};
  const auto corner = fitSaddle(draw(drawn), {3.0, 30.0}, kHalf);
  ASSERT_TRUE(corner.has_value());
  EXPECT_LT((*corner - drawn.corner).norm(), 0.02);
}

TEST(SaddleFit, FindsNothingWhereThereIsNoSuchCorner) {
  EXPECT_FALSE(fitSaddle(GrayImage(kSize, kSize, 90), {30, 30}, kHalf).has_value());
  GrayImage edge(kSize, kSize, 60);
  for (int y = 0; y < kSize; ++y) {
    std::fill(edge.row(y) + 30, edge.row(y) + kSize, std::uint8_t{190});
  }
  EXPECT_FALSE(fitSaddle(edge, {30, 30}, kHalf).has_value());
  std::mt19937_64 dice(2);
  GrayImage noise(kSize, kSize);
  std::generate(noise.pixels.begin(), noise.pixels.end(),
                [&] { return static_cast<std::uint8_t>(dice() % 256); });
  EXPECT_FALSE(fitSaddle(noise, {30, 30}, kHalf).has_value());
  EXPECT_FALSE(fitSaddle(GrayImage(1, 1), {0, 0}, kHalf).has_value());
}

TEST(SaddleFit, RefusesCornersThatAreFarFlatOrNearlyAnEdge) {
  EXPECT_FALSE(fitSaddle(draw({}), {33.0, 30.0}, kHalf).has_value());
  Drawn narrow;
  narrow.angle2 = narrow.angle1 + 0.2;
  EXPECT_FALSE(fitSaddle(draw(narrow), {30.0, 30.0}, kHalf).has_value());
  std::vector<double> flat = greys({});
  std::transform(flat.begin(), flat.end(), flat.begin(), [](double grey) { return 0.04 * grey; });
  std::mt19937_64 dice(3);
  EXPECT_FALSE(fitSaddle(exposed(flat, 0.0, dice), {30.0, 30.0}, kHalf).has_value());
}

}  // namespace
}  // namespace ringhook
