#include "camera/aravis_stereo_camera.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "camera/restart_spans.h"
#include "camera/stamp_clock.h"
#include "camera/stereo_pairing.h"
#include "core/error.h"

namespace ringhook {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// Two instants of one exposure differ by less than this part of the period.
constexpr double kPairingPart = 0.25;
/// Exposures started one after the other by command, or clocks tied to arrivals, differ more than a
/// quarter of a short period.
constexpr double kLeastTolerance_s = 0.002;
constexpr double kTurn_s = 0.002;  // images of the two cameras are waited for in such turns
/// A clock that does not follow the host's counts from another epoch: it is years off, or hours.
constexpr double kPlausible_s = 60.0;

double pairingTolerance(double rate_hz) {
  return std::max(kLeastTolerance_s, kPairingPart / rate_hz);
}

void requireRate(double rate_hz) {
  if (!(rate_hz > 0.0) || !std::isfinite(rate_hz)) {
    throw DeviceError("the cameras were asked for " + std::to_string(rate_hz) +
                      " pairs a second; it must be positive");
  }
}

Time now() {
  return Time::fromNanoseconds(
      std::chrono::nanoseconds(SteadyClock::now().time_since_epoch()).count());
}

double secondsSince(SteadyClock::time_point start) {
  return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

}  // namespace

struct AravisStereoCamera::Impl {
  explicit Impl(const AravisOptions& o);
  ~Impl();

  struct Wish {
    std::array<Window, 2> windows;
    double rate_hz = 0.0;
    bool operator==(const Wish&) const = default;
  };

  void serveWishes() noexcept;
  void grant(const Wish& asked);
  void fireAt(SteadyClock::time_point& next, double rate_hz);
  Time midExposure(int side, const GigeImage& image);
  bool collect(int side, double timeout_s);
  void rethrowFailure();
  [[nodiscard]] std::int64_t exposuresWithoutPair() const;

  AravisOptions options;
  std::array<std::unique_ptr<GigeCamera>, 2> cameras;
  Window full;
  std::array<StampClock, 2> clocks;
  RestartSpans restarts;
  StereoPairing pairing;
  std::int64_t pairs = 0;
  double lateness_s = 0.0;
  std::mutex mutex;  // guards what follows
  std::condition_variable changed;
  Wish wish;
  bool ending = false;
  std::exception_ptr failure;  // of the thread
  Wish granted;                // the thread's own
  std::thread thread;
};

AravisStereoCamera::Impl::Impl(const AravisOptions& o)
    : options(o), pairing(pairingTolerance(o.rate_hz), [this](Time exposure) {
        return restarts.covers(exposure);
      }) {
  requireRate(options.rate_hz);
  options.left.follow_host_clock = options.right.follow_host_clock =
      options.clock == CameraClock::kHost;
  cameras[0] = std::make_unique<GigeCamera>(options.left);
  cameras[1] = std::make_unique<GigeCamera>(options.right);
  const RegionLimits& left = cameras[0]->limits();
  const RegionLimits& right = cameras[1]->limits();
  full = {0, 0, left.sensor_width, left.sensor_height};
  if (full != Window{0, 0, right.sensor_width, right.sensor_height}) {
    throw DeviceError("cameras " + options.left.device + " and " + options.right.device +
                      " have sensors of different size");
  }
  wish = granted = {{full, full}, options.rate_hz};
  restarts.begin(now());
  for (auto& camera : cameras) {
    camera->setFrameRate(options.rate_hz);
    camera->start();
  }
  restarts.end(now());
  thread = std::thread([this] { serveWishes(); });
}

AravisStereoCamera::Impl::~Impl() {
  {
    const std::lock_guard lock(mutex);
    ending = true;
  }
  changed.notify_one();
  if (thread.joinable()) {
    thread.join();
  }
  // At once: to find out that a camera does not answer takes seconds.
  std::thread right([this] { cameras[1].reset(); });
  cameras[0].reset();
  right.join();
}

/// Settings, and triggers by command: whatever asks the cameras something.
void AravisStereoCamera::Impl::serveWishes() noexcept {
  const bool fires = options.left.trigger == CameraTrigger::kSoftware;
  auto next_shot = SteadyClock::now();
  try {
    while (true) {
      std::unique_lock lock(mutex);
      const auto news = [this] { return ending || wish != granted; };
      if (fires) {
        changed.wait_until(lock, next_shot, news);
      } else {
        changed.wait(lock, news);
      }
      if (ending) {
        return;
      }
      const Wish asked = wish;
      lock.unlock();
      grant(asked);
      if (fires && SteadyClock::now() >= next_shot) {
        fireAt(next_shot, asked.rate_hz);
      }
    }
  } catch (...) {
    const std::lock_guard lock(mutex);
    failure = std::current_exception();
  }
}

void AravisStereoCamera::Impl::grant(const Wish& asked) {
  std::array<Window, 2> regions;
  bool restart = false;
  for (std::size_t side = 0; side < 2; ++side) {
    const Window before = cameras[side]->region();
    regions[side] = readoutRegion(asked.windows[side], before, cameras[side]->limits());
    restart = restart || !before.sameSize(regions[side]);
  }
  if (restart) {  // an image may still be on its way out of its camera
    restarts.begin(now() - 1.0 / std::min(granted.rate_hz, asked.rate_hz));
  }
  for (std::size_t side = 0; side < 2; ++side) {
    if (asked.rate_hz != granted.rate_hz) {
      cameras[side]->setFrameRate(asked.rate_hz);
    }
    cameras[side]->setRegion(regions[side]);
  }
  if (restart) {
    restarts.end(now());
  }
  const std::lock_guard lock(mutex);
  granted = asked;
}

/// Shots stay on a grid; those that are past are left out.
void AravisStereoCamera::Impl::fireAt(SteadyClock::time_point& next, double rate_hz) {
  for (auto& camera : cameras) {
    camera->fire();
  }
  const auto period =
      std::chrono::duration_cast<SteadyClock::duration>(std::chrono::duration<double>(1 / rate_hz));
  next = std::max(next + period, SteadyClock::now());
}

/// Stamps on the host's clock mean the start of the exposure; a clock of its own is tied to the
/// arrivals, which are the calibrated delay behind mid-exposure.
Time AravisStereoCamera::Impl::midExposure(int side, const GigeImage& image) {
  const auto index = static_cast<std::size_t>(side);
  if (options.clock == CameraClock::kOwn) {
    const Time arrived = clocks[index].hostTime(image.stamp_ns, image.arrival);
    lateness_s = image.arrival - arrived;
    return arrived - options.delay_s;
  }
  const Time started = Time::fromNanoseconds(image.stamp_ns) + (image.arrival - image.real_arrival);
  lateness_s = image.arrival - started;
  if (std::abs(lateness_s) > kPlausible_s) {
    const auto& device = side == 0 ? options.left.device : options.right.device;
    throw DeviceError("camera " + device + ": its stamps are " + std::to_string(lateness_s) +
                      " s behind the host's time; expected a clock set by PTP");
  }
  return started + 0.5 * cameras[index]->exposure();
}

bool AravisStereoCamera::Impl::collect(int side, double timeout_s) {
  auto image = cameras[static_cast<std::size_t>(side)]->take(timeout_s);
  if (!image) {
    return false;
  }
  pairing.add(side, {midExposure(side, *image), image->window, std::move(image->image)});
  return true;
}

void AravisStereoCamera::Impl::rethrowFailure() {
  const std::lock_guard lock(mutex);
  if (failure) {
    std::rethrow_exception(failure);
  }
}

/// Each left something behind on one side at least: a broken image, or one without its partner.
std::int64_t AravisStereoCamera::Impl::exposuresWithoutPair() const {
  return std::max(cameras[0]->counts().lost_images + pairing.unpaired(0),
                  cameras[1]->counts().lost_images + pairing.unpaired(1));
}

AravisStereoCamera::AravisStereoCamera(const AravisOptions& options)
    : impl_(std::make_unique<Impl>(options)) {}
AravisStereoCamera::~AravisStereoCamera() = default;

Window AravisStereoCamera::fullImage() const { return impl_->full; }

void AravisStereoCamera::setWindows(const Window& left, const Window& right) {
  const auto clipped = [this](const Window& window) {
    const Window on_sensor = intersect(window, impl_->full);
    return on_sensor.empty() ? impl_->full : on_sensor;
  };
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->wish.windows = {clipped(left), clipped(right)};
  }
  impl_->changed.notify_one();
}

void AravisStereoCamera::setFrameRate(double rate_hz) {
  requireRate(rate_hz);
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->wish.rate_hz = rate_hz;
  }
  impl_->pairing.setTolerance(pairingTolerance(rate_hz));
  impl_->changed.notify_one();
}

std::optional<StereoFrame> AravisStereoCamera::grab(double timeout_s) {
  impl_->rethrowFailure();
  const auto start = SteadyClock::now();
  int side = 0;  // the one that is waited for
  while (true) {
    while (impl_->collect(0, 0.0) || impl_->collect(1, 0.0)) {
    }
    if (auto pair = impl_->pairing.take()) {
      auto& [left, right] = *pair;
      StereoFrame frame;
      frame.time = left.time + 0.5 * (right.time - left.time);
      frame.index = static_cast<std::uint64_t>(impl_->pairs++ + impl_->exposuresWithoutPair());
      frame.left_window = left.window;
      frame.right_window = right.window;
      frame.left = std::move(left.image);
      frame.right = std::move(right.image);
      return frame;
    }
    const double left_s = timeout_s - secondsSince(start);
    if (left_s <= 0.0) {
      return std::nullopt;
    }
    static_cast<void>(impl_->collect(side, std::min(left_s, kTurn_s)));
    side = 1 - side;
  }
}

AravisCounts AravisStereoCamera::counts() const {
  AravisCounts counts;
  counts.pairs = impl_->pairs;
  counts.left = impl_->cameras[0]->counts();
  counts.right = impl_->cameras[1]->counts();
  counts.unpaired_left = impl_->pairing.unpaired(0);
  counts.unpaired_right = impl_->pairing.unpaired(1);
  counts.settling = impl_->pairing.excused();
  counts.lateness_s = impl_->lateness_s;
  return counts;
}

}  // namespace ringhook
