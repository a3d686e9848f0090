#include "sim/live_exposures.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace ringhook {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(100);  // for a world that stands still

std::int64_t realNow_ns() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

std::int64_t nanoseconds(double seconds) { return static_cast<std::int64_t>(1e9 * seconds); }

}  // namespace

void LiveExposures::worldIsAt(std::int64_t real_ns) {
  {
    // The drawing threads are the last to get a processor, also while they hold this.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || !wanted_s_ || closed_) {
      return;
    }
    if (*wanted_s_ != sensor_.exposure_s) {
      sensor_.exposure_s = *wanted_s_;
      eyes_.setSensor(sensor_);
    }
    taken_ = Capture{eyes_.capture(), real_ns};
    wanted_s_.reset();
  }
  captured_.notify_all();
}

std::optional<LiveExposures::Capture> LiveExposures::capture(double exposure_s) {
  std::unique_lock lock(mutex_);
  wanted_s_ = exposure_s;
  taken_.reset();
  captured_.wait_for(lock, kPatience, [this] { return closed_ || taken_; });
  wanted_s_.reset();
  return std::exchange(taken_, std::nullopt);
}

std::optional<ExposedPair> LiveExposures::expose(const ExposureRequest& request) {
  const std::optional<Capture> capture = this->capture(request.exposure_s);
  ExposedPair pair;
  std::uint64_t frame = 0;
  {
    const std::lock_guard lock(mutex_);
    if (closed_) {
      return std::nullopt;
    }
    frame = static_cast<std::uint64_t>(pairs_++);
  }
  if (!capture) {
    for (std::size_t side = 0; side < 2; ++side) {
      pair.images[side] = GrayImage(request.regions[side].width, request.regions[side].height);
    }
    pair.start_ns = realNow_ns();
    return pair;
  }
  pair.start_ns = capture->mid_ns - nanoseconds(0.5 * request.exposure_s);
  pair.images = eyes_.develop(capture->exposure, request.regions, frame);
  const std::int64_t early_ns = capture->mid_ns + nanoseconds(transport_delay_s_) - realNow_ns();
  std::this_thread::sleep_for(std::chrono::nanoseconds(std::max<std::int64_t>(0, early_ns)));
  return pair;
}

void LiveExposures::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  captured_.notify_all();
}

std::int64_t LiveExposures::pairs() const {
  const std::lock_guard lock(mutex_);
  return pairs_;
}

}  // namespace ringhook
