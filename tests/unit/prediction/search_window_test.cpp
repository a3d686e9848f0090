#include "prediction/search_window.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "prediction/chi_square.h"

namespace ringhook {
namespace {

const std::array<Eigen::Vector3d, 4> kCorners{
    {{0.0, -0.062, 0.254}, {0.0, -0.008, 0.254}, {0.0, -0.062, 0.146}, {0.0, 0.041, -0.041}}};

PinholeView testView() {
  PinholeView view;
  view.fx = view.fy = 2500.0;
  view.cx = view.cy = 1023.5;
  view.width = view.height = 2048;
  view.cMc1.translation().x() = -0.4;
  return view;
}

Pose hookPose() { return makePoseThetaU({0.2, 0.05, 1.3}, Eigen::Vector3d(1.5, -0.3, 0.2)); }

Covariance6 someCovariance() {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  const Covariance6 A = Covariance6::NullaryExpr([&] { return normal(random); });
  Twist scale;
  scale << 0.003, 0.002, 0.004, 0.01, 0.015, 0.01;
  return scale.asDiagonal() * (A * A.transpose() / 6.0) * scale.asDiagonal();
}

// Share of poses drawn from the covariance whose points all project into the window.
double insideShare(const Window& window, const Covariance6& covariance, int draws) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  const Covariance6 root = covariance.llt().matrixL();
  int inside = 0;
  for (int i = 0; i < draws; ++i) {
    const Twist d = root * Twist::NullaryExpr([&] { return normal(random); });
    const Pose truth = hookPose() * expSe3(d);
    bool all = true;
    for (const auto& point : kCorners) {
      const auto pixel = testView().project(truth * point);
      all = all && pixel && window.contains(pixel->x(), pixel->y());
    }
    inside += all ? 1 : 0;
  }
  return static_cast<double>(inside) / draws;
}

TEST(SearchWindow, HoldsAllTruePointsWithThePromisedProbability) {
  for (const double promised : {0.5, 0.9, 0.99}) {
    SearchWindowOptions options;
    options.margin_px = 0.0;
    options.min_size_px = 1;
    options.sigmas = sigmasForProbability(promised);
    const Window window = searchWindow(testView(), hookPose(), someCovariance(), kCorners, options);
    const double share = insideShare(window, someCovariance(), 20000);
    std::printf("promised %.2f: inside %.4f, window %dx%d px\n", promised, share, window.width,
                window.height);
    EXPECT_GE(share, promised);
  }
}

// One point with one uncertain direction: the window is that point plus and minus k sigma.
TEST(SearchWindow, IsTightForOnePointAndOneDirection) {
  Covariance6 covariance = Covariance6::Zero();
  covariance(0, 0) = 1e-4;  // 10 mm along x of o
  Pose c1Mo = Pose::Identity();
  c1Mo.translation() << 0.4, 0.0, 1.25;
  SearchWindowOptions options;
  options.sigmas = 3.0;
  options.margin_px = 0.0;
  options.min_size_px = 1;
  const std::array<Eigen::Vector3d, 1> origin{Eigen::Vector3d::Zero()};
  const Window window = searchWindow(testView(), c1Mo, covariance, origin, options);
  // 1 sigma = 2500 * 0.01 / 1.25 = 20 px about column 1023.5.
  EXPECT_EQ(window.x, 963);
  EXPECT_EQ(window.x + window.width - 1, 1084);
  EXPECT_EQ(window.y, 1023);
  EXPECT_EQ(window.height, 2);
}

TEST(SearchWindow, KeepsSizesAlignmentAndTheImage) {
  SearchWindowOptions options;
  options.min_size_px = 301;
  options.max_size_px = 700;
  options.alignment_px = 16;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  int seen = 0;
  for (int i = 0; i < 2000; ++i) {
    Pose c1Mo = hookPose();
    c1Mo.translation() += Eigen::Vector3d(side(random), side(random), 0.5 * side(random));
    const Window w = searchWindow(testView(), c1Mo, someCovariance(), kCorners, options);
    if (w.empty()) {
      continue;
    }
    ++seen;
    ASSERT_EQ(w.x % 16 + w.y % 16 + w.width % 16 + w.height % 16, 0);
    ASSERT_EQ(intersect(w, Window{0, 0, 2048, 2048}), w);
    ASSERT_GE(std::min(w.width, w.height), 301);
    ASSERT_LE(std::max(w.width, w.height), 700);
  }
  EXPECT_GT(seen, 500);
}

TEST(SearchWindow, IsEmptyOutOfViewAndBehindTheCamera) {
  Pose aside = hookPose();
  aside.translation().x() += 3.0;
  EXPECT_TRUE(
      searchWindow(testView(), aside, 1e-6 * Covariance6::Identity(), kCorners, {}).empty());
  Pose behind = hookPose();
  behind.translation().z() = -1.3;
  EXPECT_TRUE(
      searchWindow(testView(), behind, 1e-6 * Covariance6::Identity(), kCorners, {}).empty());
}

}  // namespace
}  // namespace ringhook
