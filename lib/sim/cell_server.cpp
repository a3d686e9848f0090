#include "sim/cell_server.h"

#include <sys/resource.h>

#include <chrono>
#include <exception>
#include <thread>

namespace ringhook {
namespace {

constexpr int kDrawingNice = 10;

/// For this thread and the threads that it starts from now on (setpriority(2) on Linux: nice values
/// are per thread). Where ticks have real-time priority they need no yielding.
void yieldToTicks() {
  static const bool ticks_are_first = [] {
    bool permitted = false;
    std::thread([&] {
      permitted = RaisedPriority(kTickRank).reached() == ThreadPriority::kRealTime;
    }).join();
    return permitted;
  }();
  if (!ticks_are_first) {
    ::setpriority(PRIO_PROCESS, 0, kDrawingNice);
  }
}

/// Made on a thread of low priority: the renderer's own threads inherit it.
std::unique_ptr<StereoEyes> makeEyes(CellWorld& world, const StereoRig& rig,
                                     const SensorOptions& sensor) {
  std::unique_ptr<StereoEyes> eyes;
  std::exception_ptr failure;
  std::thread maker([&] {
    yieldToTicks();
    try {
      eyes = std::make_unique<StereoEyes>(world, rig, sensor);
    } catch (...) {
      failure = std::current_exception();
    }
  });
  maker.join();
  if (failure) {
    std::rethrow_exception(failure);
  }
  return eyes;
}

/// What the host's real time is ahead of its steady one [ns].
std::int64_t realMinusSteady_ns() {
  using std::chrono::duration_cast;
  using std::chrono::nanoseconds;
  const auto steady = std::chrono::steady_clock::now().time_since_epoch();
  const auto real = std::chrono::system_clock::now().time_since_epoch();
  return duration_cast<nanoseconds>(real).count() - duration_cast<nanoseconds>(steady).count();
}

}  // namespace

CellServer::CellServer(CellWorld& world, const StereoRig& true_rig,
                       const CellServerOptions& options)
    : plant_(world, options.gripper),
      controller_(plant_),
      arm_(controller_, options.arm),
      eyes_(makeEyes(world, true_rig, options.sensor)),
      exposures_(*eyes_, options.transport_delay_s),
      world_(world),
      cameras_(options.cameras, [this](const ExposureRequest& request) {
        thread_local const bool yields = (yieldToTicks(), true);  // the cameras' own threads
        static_cast<void>(yields);
        return exposures_.expose(request);
      }) {}

CellServer::~CellServer() { exposures_.close(); }

void CellServer::run(const std::atomic<bool>& stop, double seconds) {
  arm_.afterTick([this](Time next) {
    const Time steady = arm_.startedAt() + world_.time().seconds();
    exposures_.worldIsAt(steady.nanoseconds() + realMinusSteady_ns());
    cameras_.rethrowFailure();
    if (on_tick_) {
      on_tick_(world_.time());
    }
    world_.advanceTo(next);
  });
  if (arm_.waitForClient(stop)) {
    arm_.run(stop, seconds);
  }
  exposures_.close();
}

}  // namespace ringhook
