#pragma once

/// \file
/// The simulated cell as a place of its own, in real time: the RX60's controller on TCP and two
/// GigE Vision cameras, around one world. What the arm is told in a tick acts until the next one,
/// so the world is moved to the next tick as soon as one is over, in the time that is left; a tick
/// itself only reads and answers. The cameras' pictures are drawn beside it, at the rate that this
/// host manages. The belt starts when the arm's first client connects: until then nothing moves and
/// pictures are dark.

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "rig/stereo_rig.h"
#include "sim/gige_server.h"
#include "sim/live_exposures.h"
#include "sim/rx60_controller.h"
#include "sim/rx60_plant.h"
#include "sim/rx60_server.h"

namespace ringhook {

/// Physics step for a cell in real time [s]: twice the usual one, for half the processor time. What
/// that costs is in doc/simulation.md.
inline constexpr double kLivePhysicsStep = 0.001;

struct CellServerOptions {
  Rx60ServerOptions arm;
  GripperOutput gripper;
  GigeServerOptions cameras;
  SensorOptions sensor;              ///< exposure time is what the client sets
  double transport_delay_s = 0.008;  ///< of images, from mid-exposure to arrival, at least [s]
};

class CellServer {
 public:
  /// Listens from now on. The world must outlive the server. Throws DeviceError naming an address
  /// or port that cannot be had.
  CellServer(CellWorld& world, const StereoRig& true_rig, const CellServerOptions& options);
  ~CellServer();
  CellServer(const CellServer&) = delete;
  CellServer& operator=(const CellServer&) = delete;

  [[nodiscard]] Rx60Controller& controller() { return controller_; }
  [[nodiscard]] Rx60Server& arm() { return arm_; }

  /// Called after each of the controller's ticks, with the world's time.
  void onTick(std::function<void(Time)> action) { on_tick_ = std::move(action); }

  /// Waits for the arm's first client, then serves on the caller's thread until `stop` is set or
  /// seconds [s] are over. Rethrows what the cameras threw.
  void run(const std::atomic<bool>& stop, double seconds = std::numeric_limits<double>::infinity());

  [[nodiscard]] std::int64_t pairs() const { return exposures_.pairs(); }  ///< of images

 private:
  CellPlant plant_;
  Rx60Controller controller_;
  Rx60Server arm_;
  std::unique_ptr<StereoEyes> eyes_;
  LiveExposures exposures_;
  CellWorld& world_;
  std::function<void(Time)> on_tick_;
  GigeServer cameras_;  ///< last: its threads use the exposures
};

}  // namespace ringhook
