// The scene as a whole: windows, seeds, occluders, lamps, plates, and that looks leave the physics
// alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "image_reader.h"
#include "scene_view.h"
#include "sim/arm_visuals.h"
#include "sim/nominal_rig.h"
#include "sim/scene_light.h"
#include "sim/scene_motion.h"
#include "sim/sim_stereo_camera.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Everything switched on: swing, shadows, clutter, a rod passing, 3 ms of exposure, noise.
CellOptions busyCell() {
  CellOptions options = hookInView(-0.1);
  options.hook.swing_about_x = options.hook.swing_about_y = 0.2;
  options.scene.light.setup = LightSetup::side;
  options.scene.light.brightness = 0.2;
  options.scene.wall = WallKind::textured;
  options.scene.clutter = 20;
  options.scene.occluder.count = 1;
  options.scene.occluder.first_s = 0.2;
  return options;
}

SimCameraOptions longExposure() {
  SimCameraOptions options;
  options.sensor.exposure_s = 0.003;
  return options;
}

GrayImage crop(const GrayImage& image, const Window& window) {
  GrayImage part(window.width, window.height);
  for (int y = 0; y < window.height; ++y) {
    std::copy_n(image.row(window.y + y) + window.x, window.width, part.row(y));
  }
  return part;
}

double meanGrey(const GrayImage& image) {
  return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) /
         static_cast<double>(image.pixels.size());
}

TEST(SimScene, WindowIsTheCropOfTheFullImageBitByBit) {
  const Window full{};
  for (const Window& window : {Window{650, 600, 512, 512}, Window{1033, 411, 300, 257}}) {
    CellWorld one(busyCell());
    CellWorld two(busyCell());
    SimStereoCamera whole(one, nominalRig(), longExposure());
    SimStereoCamera part(two, nominalRig(), longExposure());
    whole.setWindows(full, window);
    part.setWindows(window, full);
    const StereoFrame a = frameAt(one, whole, 0.01);
    const StereoFrame b = frameAt(two, part, 0.01);
    ASSERT_EQ(b.left_window, window);
    EXPECT_TRUE(crop(a.left, window).pixels == b.left.pixels);
    EXPECT_TRUE(a.right.pixels == crop(b.right, window).pixels);
  }
}

TEST(SimScene, TwoRunsOfOneSeedShowTheSameImagesBitByBit) {
  const Window window{400, 500, 800, 700};
  std::vector<std::vector<std::uint8_t>> shown;
  for (int run = 0; run < 2; ++run) {
    CellWorld world(busyCell());
    SimStereoCamera camera(world, nominalRig(), longExposure());
    camera.setWindows(window, window);
    world.advanceTo(Time::fromSeconds(0.05));
    const StereoFrame frame = frameAt(world, camera, 0.07);
    shown.push_back(frame.left.pixels);
    shown.back().insert(shown.back().end(), frame.right.pixels.begin(), frame.right.pixels.end());
  }
  EXPECT_TRUE(shown[0] == shown[1]);
}

TEST(SimScene, AnotherSeedShowsAnotherScene) {
  SceneOptions options;
  options.occluder.count = 3;
  const SceneLight a = sceneLight(options, 1);
  const SceneLight b = sceneLight(options, 2);
  EXPECT_NE(a.key, b.key);
  EXPECT_GT((a.towards_key - b.towards_key).norm(), 1e-4);
  EXPECT_NE(drawOccluders(options, 1)[0].speed, drawOccluders(options, 2)[0].speed);
  options.seed = 7;  // from here on the cell's seed does not matter
  EXPECT_EQ(sceneLight(options, 1).key, sceneLight(options, 2).key);
}

TEST(SimScene, OccludersCrossTheMiddleWhenTheyShould) {
  SceneOptions options;
  options.occluder.count = 3;
  options.occluder.first_s = 2.0;
  options.occluder.interval_s = 4.0;
  const auto rods = drawOccluders(options, 5);
  ASSERT_EQ(rods.size(), 3U);
  for (std::size_t i = 0; i < rods.size(); ++i) {
    const double crossing = 2.0 + 4.0 * static_cast<double>(i);
    EXPECT_NEAR(rods[i].y(crossing), 0.0, 1e-12);
    EXPECT_NEAR(rods[i].y(crossing + 0.1), -0.1 * rods[i].speed, 1e-12);
    EXPECT_GE(rods[i].speed, 0.24);
    EXPECT_LE(rods[i].speed, 0.36);
  }
}

TEST(SimScene, APassingRodHidesWhatIsBehindIt) {
  CellOptions options = hookInView(-0.035 - 0.0001);
  options.hook.swing_about_x = options.hook.swing_about_y = 0.0;
  const StereoRig rig = nominalRig();
  const auto tagsSeen = [&](const CellOptions& cell) {
    CellWorld world(cell);
    SimStereoCamera camera(world, rig);
    const StereoFrame frame = frameAt(world, camera, 0.01);
    return readTags(frame.left).count(0);
  };
  EXPECT_EQ(tagsSeen(options), 1U);
  // The left camera sees the plate through this point of the rods' plane.
  const Vector3d eye = rig.fMc1->translation();
  const Vector3d plate(0.42, options.belt.start_y, 0.83);
  const double share = (0.80 - eye.x()) / (plate.x() - eye.x());
  options.scene.occluder.count = 1;
  options.scene.occluder.speed_spread = 0.0;
  options.scene.occluder.first_s = (eye + share * (plate - eye)).y() / options.scene.occluder.speed;
  EXPECT_EQ(tagsSeen(options), 0U);
}

TEST(SimScene, LooksLeaveThePhysicsAlone) {
  CellOptions bare = busyCell();
  bare.scene = {};
  CellWorld plain(bare);
  CellWorld busy(busyCell());
  SimStereoCamera camera(busy, nominalRig());
  camera.setWindows({0, 0, 16, 16}, {0, 0, 16, 16});
  JointVector velocity;
  velocity << 0.2, -0.1, 0.1, 0.3, -0.2, 0.1;
  for (CellWorld* world : {&plain, &busy}) {
    world->setGripper(true);
    world->setJointVelocity(velocity, 0.2);
    world->advanceTo(Time::fromSeconds(0.3));
  }
  const CellTruth a = truth(plain);
  const CellTruth b = truth(busy);
  EXPECT_TRUE(a.fMe.matrix() == b.fMe.matrix());
  EXPECT_TRUE(a.hooks.front().fMo.matrix() == b.hooks.front().fMo.matrix());
  EXPECT_TRUE(a.rings.front().fMr.matrix() == b.rings.front().fMr.matrix());
  EXPECT_EQ(a.grip_force, b.grip_force);
}

TEST(SimScene, BrightnessAndGainSetTheImagesLevel) {
  const Window window{200, 100, 400, 200};  // of the wall
  const auto level = [&](double brightness, double gain, double exposure_s) {
    CellOptions options = hookInView(-0.1);
    options.scene.light.brightness = brightness;
    CellWorld world(options);
    SimCameraOptions camera_options;
    camera_options.sensor.gain = gain;
    camera_options.sensor.exposure_s = exposure_s;
    SimStereoCamera camera(world, nominalRig(), camera_options);
    camera.setWindows(window, window);
    return meanGrey(frameAt(world, camera, 0.01).left);
  };
  const double normal = level(1.0, 1.0, 0.0005);
  EXPECT_GT(normal, 30.0);
  EXPECT_NEAR(level(0.1, 1.0, 0.0005) / normal, 0.1, 0.005);
  EXPECT_NEAR(level(0.1, 8.0, 0.0005) / normal, 0.8, 0.02);
  EXPECT_NEAR(level(0.1, 1.0, 0.005) / normal, 1.0, 0.02);
}

TEST(SimScene, GripperPlateIsSeenWhereItsFrameSays) {
  CellWorld world(hookInView(0.1));
  const StereoRig rig = nominalRig();
  SimStereoCamera camera(world, rig);
  const StereoFrame frame = frameAt(world, camera, 0.01);
  const Pose c1Mg = rig.fMc1->inverse() * truth(world).fMe * eMg();
  const auto tags = readTags(frame.left);
  const TagPlateFace face = gripperPlateFace();
  for (std::size_t place = 0; place < face.ids.size(); ++place) {
    ASSERT_EQ(tags.count(face.ids[place]), 1U);
    const auto corners = tagCornersOnPlate(face, place);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector2d truth_px = projected(rig.left, c1Mg, corners[i]);
      EXPECT_LT((tags.at(face.ids[place])[i] - truth_px).norm(), 0.3);
    }
  }
}

}  // namespace
}  // namespace ringhook
