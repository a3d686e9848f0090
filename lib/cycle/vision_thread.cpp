#include "cycle/vision_thread.h"

#include <utility>

#include "cycle/servo_loop.h"

namespace ringhook {
namespace {

constexpr double kWait_s = 0.05;  // for a frame, before looking whether the end has come

}  // namespace

VisionThread::VisionThread(StereoCamera& camera, VisionStep& vision, LoopObserver& observer)
    : camera_(camera), vision_(vision), observer_(observer) {
  thread_ = std::thread([this] { run(); });
}

VisionThread::~VisionThread() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  thread_.join();
}

void VisionThread::restart() {
  const std::lock_guard lock(mutex_);
  restart_ = true;
  estimate_.reset();
}

std::optional<HookFilterState> VisionThread::newest(const ArmState& state) {
  const std::lock_guard lock(mutex_);
  now_ = state.time;
  if (failure_) {
    std::rethrow_exception(failure_);
  }
  return estimate_;
}

std::int64_t VisionThread::passedOver() const {
  const std::lock_guard lock(mutex_);
  return passed_over_;
}

void VisionThread::run() noexcept {
  try {
    while (goOn()) {
      work();
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    estimate_.reset();
  }
}

/// Whether to go on; first serves a wish to start anew.
bool VisionThread::goOn() {
  bool anew = false;
  {
    const std::lock_guard lock(mutex_);
    if (ending_) {
      return false;
    }
    anew = std::exchange(restart_, false);
  }
  if (anew) {
    vision_.restart();
    camera_.setWindows(vision_.windows()[0], vision_.windows()[1]);
    camera_.setFrameRate(vision_.rateHz());
  }
  return true;
}

std::optional<StereoFrame> VisionThread::newestFrame() {
  std::optional<StereoFrame> frame = camera_.grab(kWait_s);
  while (frame) {
    std::optional<StereoFrame> newer = camera_.grab(0.0);
    if (!newer) {
      break;
    }
    frame = std::move(newer);
    const std::lock_guard lock(mutex_);
    ++passed_over_;
  }
  return frame;
}

void VisionThread::work() {
  const std::optional<StereoFrame> frame = newestFrame();
  if (!frame) {
    return;
  }
  const VisionReport report = vision_.process(*frame);
  camera_.setWindows(vision_.windows()[0], vision_.windows()[1]);
  camera_.setFrameRate(vision_.rateHz());
  double age_s = 0.0;
  {
    const std::lock_guard lock(mutex_);
    if (!restart_) {  // asked for meanwhile: what this frame says is of the old hook
      estimate_ = vision_.estimate();
    }
    age_s = now_ - frame->time;
  }
  observer_.onFrame(*frame, report, age_s);
}

}  // namespace ringhook
