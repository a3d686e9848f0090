// The part of a shadow map that a picture needs, against points drawn at random on what it shows.

#include "sim/shadow_part.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace ringhook {
namespace {

constexpr Window kSmall{-100, -80, 200, 160};

/// Looks along -x of f from 1.75 m, rows down.
Pinhole eye() {
  Pinhole pinhole;
  pinhole.fMc = Pose::Identity();
  pinhole.fMc.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  pinhole.fMc.translation() << 1.75, -0.2, 0.7;
  pinhole.focal_px = 2500.0;
  return pinhole;
}

/// Two metres about (0, 0, 0.7), lit from the front, the side and above.
ShadowBox map() {
  ShadowBox box;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, 0.8, 0.5).normalized()).toRotationMatrix();
  box.clip.topLeftCorner<3, 3>() = turn;
  box.clip.topRightCorner<3, 1>() = -turn * Eigen::Vector3d(0.0, 0.0, 0.7);
  box.side = 1024;
  return box;
}

Solid solidAt(const Eigen::Vector3d& middle_f, const Eigen::Vector3d& half) {
  Solid solid;
  solid.fMs = Eigen::Translation3d(middle_f) *
              Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 0.2, 0.1).normalized());
  solid.half = half;
  return solid;
}

Eigen::Vector2d texel(const ShadowBox& box, const Eigen::Vector3d& point_f) {
  const Eigen::Vector3d clip = (box.clip * point_f.homogeneous()).head<3>();
  return 0.5 * (clip.head<2>().array() + 1.0) * box.side;
}

TEST(ShadowPart, HoldsEveryPointOfASolidThatTheWindowShows) {
  const ShadowBox box = map();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  for (const Eigen::Vector3d& half :
       {Eigen::Vector3d(0.02, 0.03, 0.2), Eigen::Vector3d(2.0, 2.0, 0.001)}) {
    const Solid solid = solidAt({0.3, -0.15, 0.68}, half);
    const Window texels = shadowTexels(box, {solid}, {{eye(), kSmall}});
    int shown = 0;
    for (int i = 0; i < 200000; ++i) {
      const Eigen::Vector3d own(within(random), within(random), within(random));
      const Eigen::Vector3d point_f = solid.fMs * half.cwiseProduct(own);
      const Eigen::Vector3d point_c = eye().fMc.inverse() * point_f;
      const Eigen::Vector2d pixel = eye().focal_px * point_c.hnormalized();
      const Eigen::Vector2d at = texel(box, point_f);
      const bool in_map = (at.array() >= 0.0).all() && (at.array() < box.side).all();
      if (point_c.z() > 0.0 && kSmall.contains(pixel.x(), pixel.y()) && in_map) {
        ++shown;
        ASSERT_TRUE(texels.contains(at.x(), at.y())) << at.transpose();
      }
    }
    EXPECT_GT(shown, 20);
  }
}

TEST(ShadowPart, OfASmallThingIsSmall) {
  const ShadowBox box = map();
  const Solid hook = solidAt({0.3, -0.15, 0.68}, {0.01, 0.01, 0.1});
  const Window texels = shadowTexels(box, {hook}, {{eye(), kSmall}});
  EXPECT_FALSE(texels.empty());
  EXPECT_LT(texels.width * texels.height, box.side * box.side / 20);
}

TEST(ShadowPart, OfWhatLiesBesideTheWindowIsNothing) {
  const Solid beside = solidAt({0.3, 0.4, 0.68}, {0.01, 0.01, 0.1});
  EXPECT_TRUE(shadowTexels(map(), {beside}, {{eye(), kSmall}}).empty());
  EXPECT_TRUE(shadowTexels(map(), {beside}, {{eye(), Window{}}}).empty());
}

TEST(ShadowPart, ASolidBetweenLampAndThingThrowsIntoItAndOneFarAsideDoesNot) {
  const ShadowBox box = map();
  const Eigen::Vector3d place(0.3, -0.15, 0.68);
  const Window texels = shadowTexels(box, {solidAt(place, {0.01, 0.01, 0.1})}, {{eye(), kSmall}});
  const Eigen::Vector3d along = box.clip.row(2).head<3>().transpose();  // of the light
  const Eigen::Vector3d across = box.clip.row(0).head<3>().transpose();
  const Eigen::Vector3d size(0.01, 0.01, 0.01);
  EXPECT_TRUE(throwsInto(solidAt(place + 0.3 * along, size), box, texels));
  EXPECT_FALSE(throwsInto(solidAt(place + 0.4 * across, size), box, texels));
}

}  // namespace
}  // namespace ringhook
