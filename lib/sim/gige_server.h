#pragma once

/// \file
/// The cell's two cameras as GigE Vision devices on a network: Aravis's fake cameras, with images
/// from a source of ours. They answer GVCP on port 3956 of one address each (the port is the
/// standard's, so two cameras need two addresses), describe themselves by GenICam (sensor, region,
/// exposure, frame rate, trigger) and stream by GVSP. Running freely, both expose at whole
/// multiples of their period of the host's real-time clock, so equal rates are exposures in step,
/// as with cameras on one PTP clock. Stamps are the host's real time.

#include <cstdint>
#include <memory>
#include <string>

#include "sim/camera_waker.h"
#include "sim/shared_trigger.h"

namespace ringhook {

struct GigeServerOptions {
  std::string left_address = "127.0.0.1";   ///< of an interface of this host
  std::string right_address = "127.0.0.2";  ///< likewise, another one
  double lost_packets = 0.0;                ///< share of stream packets that are not sent
};

/// Side of the square sensor that Aravis's fake camera has [px].
inline constexpr int kGigeSensorSide = 2048;

class GigeServer {
 public:
  /// Serves from now on. Throws DeviceError naming the address that cannot be had.
  GigeServer(const GigeServerOptions& options, PairSource source);
  /// Waits for the source to return, if it is at work.
  ~GigeServer();
  GigeServer(const GigeServer&) = delete;
  GigeServer& operator=(const GigeServer&) = delete;

  /// Images sent so far, of the left (0) or right (1) camera.
  [[nodiscard]] std::int64_t sent(int side) const;
  /// Rethrows what the source threw, if anything.
  void rethrowFailure() const;

 private:
  struct Camera;
  SharedTrigger trigger_;
  std::unique_ptr<Camera> cameras_[2];
  std::unique_ptr<CameraWaker> waker_;
};

}  // namespace ringhook
