#include "sim/sim_stereo_camera.h"

#include <array>
#include <cmath>
#include <deque>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/atomic_file.h"
#include "core/error.h"
#include "sim/cell_world.h"
#include "sim/stereo_eyes.h"

namespace ringhook {
namespace {

constexpr std::size_t kQueueLength = 32;

}  // namespace

struct SimStereoCamera::Impl {
  Impl(CellWorld& cell, const StereoRig& rig, const SimCameraOptions& chosen)
      : world(cell),
        options(chosen),
        eyes(cell, rig, chosen.sensor),
        windows{eyes.fullImage(), eyes.fullImage()} {}
  void expose();
  [[nodiscard]] Window clipped(const Window& window) const;

  CellWorld& world;
  SimCameraOptions options;
  StereoEyes eyes;
  std::array<Window, 2> windows;
  std::uint64_t next_index = 0;
  std::deque<StereoFrame> queue;
  int schedule = 0;
};

void SimStereoCamera::Impl::expose() {
  const CapturedExposure exposure = eyes.capture();
  StereoFrame frame;
  frame.time = exposure.time;
  frame.index = next_index++;
  frame.left_window = windows[0];
  frame.right_window = windows[1];
  auto images = eyes.develop(exposure, windows, frame.index);
  frame.left = std::move(images[0]);
  frame.right = std::move(images[1]);
  queue.push_back(std::move(frame));
  if (queue.size() > kQueueLength) {
    queue.pop_front();
  }
}

Window SimStereoCamera::Impl::clipped(const Window& window) const {
  const Window inside = intersect(window, eyes.fullImage());
  return inside.empty() ? eyes.fullImage() : inside;
}

SimStereoCamera::SimStereoCamera(CellWorld& world, const StereoRig& true_rig,
                                 const SimCameraOptions& options)
    : impl_(std::make_shared<Impl>(world, true_rig, options)) {
  // The world keeps its callbacks for ever; this one ends with the camera.
  const double period = 1.0 / options.rate_hz;
  const double phase = std::ceil(world.time().seconds() / period) * period;
  impl_->schedule = world.every(period, phase, [weak = std::weak_ptr<Impl>(impl_)](Time) {
    if (const auto impl = weak.lock()) {
      impl->expose();
    }
  });
}

SimStereoCamera::~SimStereoCamera() = default;

Window SimStereoCamera::fullImage() const { return impl_->eyes.fullImage(); }

void SimStereoCamera::setWindows(const Window& left, const Window& right) {
  impl_->windows = {impl_->clipped(left), impl_->clipped(right)};
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
  impl_->eyes.draw({fMc, focal_px}, {-width / 2, -height / 2, width, height}, drawn);
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
