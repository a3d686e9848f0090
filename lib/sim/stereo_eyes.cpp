#include "sim/stereo_eyes.h"

#include <algorithm>
#include <future>

#include "core/error.h"
#include "sim/camera_eye.h"
#include "sim/cell_visuals.h"
#include "sim/cell_world.h"
#include "sim/exposure.h"
#include "sim/mujoco_handles.h"
#include "sim/scene_light.h"
#include "sim/scene_motion.h"

namespace ringhook {
namespace {

const StereoRig& checked(const StereoRig& rig) {
  if (!rig.right || !rig.fMc1) {
    throw Error("the simulated stereo camera needs a rig of two cameras with fMc1");
  }
  return rig;
}

MujocoHandles painted(const CellWorld& world) {
  const MujocoHandles handles = mujocoHandles(world);
  paintTextures(*handles.model, world.options().scene, world.options().seed);
  return handles;
}

std::array<CameraEye, 2> eyesOf(const StereoRig& rig) {
  return {CameraEye(rig.left, *rig.fMc1), CameraEye(*rig.right, *rig.fMc1 * rig.c2Mc1.inverse())};
}

}  // namespace

struct StereoEyes::Impl {
  Impl(CellWorld& cell, const StereoRig& rig, const SensorOptions& options)
      : world(cell),
        mujoco(painted(cell)),
        full{0, 0, rig.left.width, rig.left.height},
        motion(mujoco, cell.options().scene, cell.options().seed),
        sensor(options),
        eyes(eyesOf(rig)),
        renderer(*mujoco.model, sceneLight(cell.options().scene, cell.options().seed),
                 std::max(eyes[0].plane().width, eyes[1].plane().width),
                 std::max(eyes[0].plane().height, eyes[1].plane().height)) {}

  void collect(std::size_t side, const std::array<Window, 2>& windows, double weight) {
    if (!windows[side].empty()) {
      eyes[side].collect(renderer, weight);
    }
  }

  CellWorld& world;
  MujocoHandles mujoco;
  Window full;
  SceneMotion motion;
  SensorNoise sensor;
  std::array<CameraEye, 2> eyes;
  Renderer renderer;
  ExposureEnds ends;
};

StereoEyes::StereoEyes(CellWorld& world, const StereoRig& true_rig, const SensorOptions& sensor)
    : impl_(std::make_unique<Impl>(world, checked(true_rig), sensor)) {}
StereoEyes::~StereoEyes() = default;

const Window& StereoEyes::fullImage() const { return impl_->full; }
const SensorOptions& StereoEyes::sensor() const { return impl_->sensor.options(); }
void StereoEyes::setSensor(const SensorOptions& sensor) { impl_->sensor = SensorNoise(sensor); }

CapturedExposure StereoEyes::capture() {
  Impl& my = *impl_;
  CapturedExposure exposure;
  exposure.time = my.world.time();
  const double time_s = exposure.time.seconds();
  const double exposure_s = my.sensor.options().exposure_s;
  my.motion.solidsAt(time_s, -0.5 * exposure_s, my.ends.start);
  my.motion.solidsAt(time_s, 0.5 * exposure_s, my.ends.end);
  double motion_px = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const CameraEye& eye = my.eyes[side];
    motion_px = std::max(motion_px, largestMotion(my.ends, eye.pinhole(), eye.plane()));
    exposure.moving[side] = movingParts(my.ends, eye.pinhole(), eye.plane());
  }
  for (const SubInstant& instant : subInstants(subInstantCount(motion_px), exposure_s)) {
    exposure.weights.push_back(instant.weight);
    my.motion.solidsAt(time_s, instant.at, exposure.solids.emplace_back());
  }
  return exposure;
}

std::array<GrayImage, 2> StereoEyes::develop(const CapturedExposure& exposure,
                                             const std::array<Window, 2>& windows,
                                             std::uint64_t frame) {
  Impl& my = *impl_;
  for (std::size_t side = 0; side < 2; ++side) {
    my.eyes[side].begin(windows[side], exposure.moving[side]);
  }
  std::vector<SeenPart> seen;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!windows[side].empty()) {
      seen.push_back({my.eyes[side].pinhole(), my.eyes[side].seen()});
    }
  }
  const std::uint64_t seed = my.world.options().seed;
  std::array<GrayImage, 2> images;
  std::future<GrayImage> left;
  for (std::size_t i = 0; i < exposure.weights.size(); ++i) {
    my.renderer.setScene(exposure.solids[i], seen);
    my.collect(0, windows, exposure.weights[i]);
    if (i + 1 == exposure.weights.size() && !windows[0].empty()) {
      left = std::async(std::launch::async,  // while the right side is drawn
                        [&my, seed, frame] {
                          return my.eyes[0].develop(my.sensor, {seed, frame, 0});
                        });
    }
    my.collect(1, windows, exposure.weights[i]);
  }
  if (!windows[1].empty()) {
    images[1] = my.eyes[1].develop(my.sensor, {seed, frame, 1});
  }
  if (left.valid()) {
    images[0] = left.get();
  }
  return images;
}

void StereoEyes::draw(const Pinhole& eye, const Window& plane, ColourImage& image) {
  Impl& my = *impl_;
  my.motion.solidsAt(my.world.time().seconds(), 0.0, my.ends.start);
  my.renderer.setScene(my.ends.start, {{eye, plane}});
  my.renderer.drawColour(eye, plane, image);
}

}  // namespace ringhook
