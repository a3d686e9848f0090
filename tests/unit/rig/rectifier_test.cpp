#include "rig/rectifier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "sample_rig.h"

namespace ringhook {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A smooth image: grey values known at any position.
double grey(double u, double v) {
  return 128.0 + 60.0 * std::sin(u / 11.0) + 50.0 * std::cos(v / 13.0 + u / 40.0);
}

GrayImage smoothImage(const Window& w) {
  GrayImage image(w.width, w.height);
  for (int y = 0; y < w.height; ++y) {
    for (int x = 0; x < w.width; ++x) {
      image.row(y)[x] = static_cast<std::uint8_t>(std::lround(grey(w.x + x, w.y + y)));
    }
  }
  return image;
}

StereoFrame frameOf(const Window& left, const Window& right) {
  StereoFrame frame;
  frame.left_window = left;
  frame.right_window = right;
  frame.left = smoothImage(left);
  frame.right = smoothImage(right);
  return frame;
}

constexpr Window kFull{0, 0, 512, 464};

TEST(Rectifier, PutsCorrespondingPointsOnOneRow) {
  const StereoRig rig = test::sampleRig();
  const Rectifier rectifier(rig);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-0.15, 0.15);
  for (int i = 0; i < 300; ++i) {
    // A point before both cameras, projected through the true lenses.
    const Vector3d p1(0.2 + place(random), place(random), 1.3 + place(random));
    const Vector3d p2 = rig.c2Mc1 * p1;
    const Vector2d left = rectifier.rectifyPoint(0, projectNormalised(rig.left, p1.hnormalized()));
    const Vector2d right =
        rectifier.rectifyPoint(1, projectNormalised(*rig.right, p2.hnormalized()));
    EXPECT_NEAR(left.y(), right.y(), 1e-8);
    // And each view is the pinhole camera that it claims to be.
    EXPECT_LT((left - *rectifier.view(0).project(p1)).norm(), 1e-8);
    EXPECT_LT((right - *rectifier.view(1).project(p1)).norm(), 1e-8);
  }
  EXPECT_EQ(rectifier.view(0).cx, rectifier.view(1).cx);
  EXPECT_LT(rectifier.view(0).cMc1.translation().norm(), 1e-15);
  EXPECT_NEAR(rectifier.view(1).cMc1.translation().x(), -baseline(rig), 1e-12);
}

TEST(Rectifier, TakesPointsThereAndBack) {
  for (const int coefficients : {4, 5, 8}) {
    const Rectifier rectifier(test::sampleRig(2048, coefficients));
    for (int u = 0; u < 2048; u += 97) {
      for (int v = 0; v < 2000; v += 89) {
        const Vector2d back = rectifier.distortPoint(1, rectifier.rectifyPoint(1, {u, v}));
        EXPECT_LT((back - Vector2d(u, v)).norm(), 1e-6);
      }
    }
  }
}

TEST(Rectifier, ShowsEveryRawPixelOfVergedCameras) {
  const Rectifier rectifier(test::sampleRig());
  for (const int side : {0, 1}) {
    const Window content = rectifier.rectifiedWindow(side, kFull);
    for (const Vector2d& corner :
         {Vector2d(0, 0), Vector2d(511, 0), Vector2d(0, 463), Vector2d(511, 463)}) {
      const Vector2d p = rectifier.rectifyPoint(side, corner);
      EXPECT_TRUE(content.contains(p.x(), p.y()));
    }
    const PinholeView& view = rectifier.view(side);
    EXPECT_EQ(intersect(content, {0, 0, view.width, view.height}), content);
  }
}

TEST(Rectifier, InterpolatesGreyValuesAtTheMappedPosition) {
  const Rectifier rectifier(test::sampleRig());
  const RectifiedFrame frame = rectifier.rectify(frameOf({100, 90, 256, 256}, {120, 80, 256, 256}));
  for (const int side : {0, 1}) {
    const RectifiedView& view = frame.views[static_cast<std::size_t>(side)];
    ASSERT_GT(view.window.width, 220);
    ASSERT_GT(view.window.height, 220);
    for (int y = 0; y < view.window.height; ++y) {
      for (int x = 0; x < view.window.width; ++x) {
        const Vector2d raw = rectifier.distortPoint(side, {view.window.x + x, view.window.y + y});
        EXPECT_NEAR(view.image.row(y)[x], grey(raw.x(), raw.y()), 1.5);
      }
    }
  }
}

TEST(Rectifier, WindowResultEqualsCropOfTheFullResult) {
  const Rectifier rectifier(test::sampleRig());
  const RectifiedFrame full = rectifier.rectify(frameOf(kFull, kFull));
  const RectifiedFrame part = rectifier.rectify(frameOf({33, 51, 300, 200}, {190, 220, 211, 240}));
  for (std::size_t side = 0; side < 2; ++side) {
    const RectifiedView& p = part.views[side];
    const RectifiedView& f = full.views[side];
    ASSERT_EQ(intersect(p.window, f.window), p.window);
    ASSERT_GT(p.window.width * p.window.height, 40000);
    for (int y = 0; y < p.window.height; ++y) {
      const std::uint8_t* expected =
          f.image.row(y + p.window.y - f.window.y) + p.window.x - f.window.x;
      ASSERT_TRUE(std::equal(p.image.row(y), p.image.row(y) + p.window.width, expected)) << y;
    }
  }
}

TEST(Rectifier, RawWindowCoversWhatWasAskedForAndLittleMore) {
  const Rectifier rectifier(test::sampleRig());
  std::mt19937 random(3);
  std::uniform_int_distribution<int> centre(200, 300);
  std::uniform_int_distribution<int> size(20, 150);
  for (int i = 0; i < 100; ++i) {
    const Vector2d p = rectifier.rectifyPoint(i % 2, Vector2d(centre(random), centre(random)));
    const int w = size(random);
    const int h = size(random);
    const Window wanted{static_cast<int>(p.x()) - w / 2, static_cast<int>(p.y()) - h / 2, w, h};
    const Window raw = rectifier.rawWindow(i % 2, wanted);
    const Window got = rectifier.rectifiedWindow(i % 2, raw);
    EXPECT_EQ(intersect(got, wanted), wanted);
    EXPECT_LT(raw.width * raw.height, 1.25 * (w + 12) * (h + 12));
  }
}

TEST(Rectifier, OfOneCameraOnlyUndistorts) {
  StereoRig rig = test::sampleRig();
  rig.right.reset();
  const Rectifier rectifier(rig);
  EXPECT_FALSE(rectifier.stereo());
  EXPECT_TRUE(rectifier.view(0).cMc1.isApprox(Pose::Identity()));
  EXPECT_EQ(rectifier.view(0).fx, rig.left.K(0, 0));
  const Vector2d pixel = projectNormalised(rig.left, {0.1, -0.2});
  EXPECT_LT(
      (rectifier.rectifyPoint(0, pixel) - *rectifier.view(0).project({0.1, -0.2, 1.0})).norm(),
      1e-8);
  StereoFrame mono = frameOf(kFull, kFull);
  EXPECT_THROW((void)rectifier.rectify(mono), InputError);
  mono.right = {};
  EXPECT_EQ(rectifier.rectify(mono).views.size(), 1U);
}

TEST(Rectifier, NamesBothSizesOfAnImageThatIsNotTheRigs) {
  const Rectifier rectifier(test::sampleRig());
  const Window other{0, 0, 640, 480};
  try {
    (void)rectifier.rectify(frameOf(other, other));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("640x480"));
    EXPECT_THAT(e.what(), testing::HasSubstr("512x464"));
  }
}

}  // namespace
}  // namespace ringhook
