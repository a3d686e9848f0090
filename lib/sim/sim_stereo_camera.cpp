#include "sim/sim_stereo_camera.h"

#include <cmath>
#include <deque>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "sim/camera_eye.h"
#include "sim/cell_visuals.h"
#include "sim/cell_world.h"
#include "sim/mujoco_handles.h"
#include "sim/scene_light.h"
#include "sim/scene_motion.h"

namespace ringhook {
namespace {

constexpr std::size_t kQueueLength = 32;

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

}  // namespace

struct SimStereoCamera::Impl {
  Impl(CellWorld& cell, const StereoRig& rig, const SimCameraOptions& chosen);
  void expose(Time time);
  /// Adds up the light of one exposure in both eyes.
  void collect(double time_s);
  [[nodiscard]] Window clipped(const Window& window) const;

  CellWorld& world;
  SimCameraOptions options;
  MujocoHandles mujoco;
  Window full;
  SceneMotion motion;
  SensorNoise sensor;
  CameraEye left;
  CameraEye right;
  Renderer renderer;
  Window left_window;
  Window right_window;
  std::uint64_t next_index = 0;
  std::deque<StereoFrame> queue;
  int schedule = 0;
  ExposureEnds ends;
  std::vector<Solid> solids;
};

SimStereoCamera::Impl::Impl(CellWorld& cell, const StereoRig& rig, const SimCameraOptions& chosen)
    : world(cell),
      options(chosen),
      mujoco(painted(cell)),
      full{0, 0, rig.left.width, rig.left.height},
      motion(mujoco, cell.options().scene, cell.options().seed),
      sensor(chosen.sensor),
      left(rig.left, *rig.fMc1),
      right(*rig.right, *rig.fMc1 * rig.c2Mc1.inverse()),
      renderer(*mujoco.model, sceneLight(cell.options().scene, cell.options().seed),
               std::max(left.plane().width, right.plane().width),
               std::max(left.plane().height, right.plane().height)),
      left_window(full),
      right_window(full) {}

void SimStereoCamera::Impl::collect(double time_s) {
  const double exposure_s = options.sensor.exposure_s;
  motion.solidsAt(time_s, -0.5 * exposure_s, ends.start);
  motion.solidsAt(time_s, 0.5 * exposure_s, ends.end);
  double motion_px = 0.0;
  for (CameraEye* eye : {&left, &right}) {
    motion_px = std::max(motion_px, largestMotion(ends, eye->pinhole(), eye->plane()));
    eye->begin(eye == &left ? left_window : right_window,
               movingParts(ends, eye->pinhole(), eye->plane()));
  }
  for (const SubInstant& instant : subInstants(subInstantCount(motion_px), exposure_s)) {
    motion.solidsAt(time_s, instant.at, solids);
    renderer.setScene(solids);
    left.collect(renderer, instant.weight);
    right.collect(renderer, instant.weight);
  }
}

void SimStereoCamera::Impl::expose(Time time) {
  const std::uint64_t seed = world.options().seed;
  StereoFrame frame;
  frame.time = time;
  frame.index = next_index++;
  frame.left_window = left_window;
  frame.right_window = right_window;
  collect(time.seconds());
  frame.left = left.develop(sensor, {seed, frame.index, 0});
  frame.right = right.develop(sensor, {seed, frame.index, 1});
  queue.push_back(std::move(frame));
  if (queue.size() > kQueueLength) {
    queue.pop_front();
  }
}

Window SimStereoCamera::Impl::clipped(const Window& window) const {
  const Window inside = intersect(window, full);
  return inside.empty() ? full : inside;
}

SimStereoCamera::SimStereoCamera(CellWorld& world, const StereoRig& true_rig,
                                 const SimCameraOptions& options)
    : impl_(std::make_shared<Impl>(world, checked(true_rig), options)) {
  // The world keeps its callbacks for ever; this one ends with the camera.
  const double period = 1.0 / options.rate_hz;
  const double phase = std::ceil(world.time().seconds() / period) * period;
  impl_->schedule = world.every(period, phase, [weak = std::weak_ptr<Impl>(impl_)](Time time) {
    if (const auto impl = weak.lock()) {
      impl->expose(time);
    }
  });
}

SimStereoCamera::~SimStereoCamera() = default;

Window SimStereoCamera::fullImage() const { return impl_->full; }

void SimStereoCamera::setWindows(const Window& left, const Window& right) {
  impl_->left_window = impl_->clipped(left);
  impl_->right_window = impl_->clipped(right);
}

void SimStereoCamera::setFrameRate(double rate_hz) {
  if (!(rate_hz > 0.0)) {
    throw DeviceError("frame rate " + std::to_string(rate_hz) + " Hz: expected a positive rate");
  }
  impl_->world.setPeriod(impl_->schedule, 1.0 / std::min(rate_hz, impl_->options.highest_rate_hz));
}

std::optional<StereoFrame> SimStereoCamera::grab(double /*timeout_s*/) {
  auto& queue = impl_->queue;
  if (queue.empty() ||
      queue.front().time + impl_->options.transport_delay_s > impl_->world.time()) {
    return std::nullopt;
  }
  StereoFrame frame = std::move(queue.front());
  queue.pop_front();
  return frame;
}

bool SimStereoCamera::finished() const { return false; }

void SimStereoCamera::savePicture(const std::filesystem::path& path, const Pose& fMc,
                                  double field_of_view, int width, int height) {
  const double focal_px = 0.5 * width / std::tan(0.5 * field_of_view);
  ColourImage drawn;
  impl_->motion.solidsAt(impl_->world.time().seconds(), 0.0, impl_->solids);
  impl_->renderer.setScene(impl_->solids);
  impl_->renderer.drawColour({fMc, focal_px}, {-width / 2, -height / 2, width, height}, drawn);
  AtomicFile file(path);
  cv::Mat bgr;
  try {
    cv::cvtColor(cv::Mat(height, width, CV_8UC4, drawn.pixels.data()), bgr, cv::COLOR_RGBA2BGR);
    if (!cv::imwrite(file.temporaryPath().string(), bgr)) {
      throw Error("cannot write the picture " + path.string());
    }
  } catch (const cv::Exception& problem) {
    throw Error("cannot write the picture " + path.string() + ": " + problem.err);
  }
  file.commit();
}

}  // namespace ringhook
