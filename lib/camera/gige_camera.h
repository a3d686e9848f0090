#pragma once

/// \file
/// One GigE Vision camera, by Aravis: opened by its address or serial number, set up by GenICam
/// features, read by a thread of Aravis's own that puts packets together. Grey images of 8 bits.
/// Aravis speaks to the device about its settings by one question and answer at a time, each of a
/// fraction of a millisecond on a good line and up to seconds on a bad one; nothing of that may
/// stand in the way of images, so settings and images may be used from two threads.
/// Standards: GigE Vision 2.0 (GVCP, GVSP), GenICam SFNC.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "camera/readout_region.h"
#include "core/image.h"
#include "core/time.h"

namespace ringhook {

/// What starts an exposure.
enum class CameraTrigger {
  kFreeRun,   ///< the camera's own clock, at its frame rate
  kSoftware,  ///< a command over the network
  kLine       ///< an electric input: both cameras on one wire
};

struct GigeCameraOptions {
  /// IPv4 address ("192.168.0.11"): spoken to directly. Anything else is a serial number, looked
  /// for by a broadcast on every network interface.
  std::string device;
  CameraTrigger trigger = CameraTrigger::kFreeRun;
  std::string line = "Line1";      ///< of that input, as the camera names it
  double exposure_s = 0.0005;      ///< [s]
  std::optional<double> gain;      ///< in the camera's unit (dB for most); nothing: left as it is
  bool follow_host_clock = false;  ///< switch IEEE 1588 on, where the camera has it
  int packet_bytes = 1500;         ///< largest packet that the line carries whole, headers included
  int buffers = 12;                ///< images that may wait to be taken
};

/// One image as the camera sent it.
struct GigeImage {
  std::int64_t stamp_ns = 0;  ///< the camera's clock [ns]
  Time arrival;               ///< of its first packet, host's steady clock
  Time real_arrival;          ///< the same, host's real-time clock (UTC)
  Window window;              ///< region that it was taken with
  GrayImage image;            ///< pixels of `window`
};

/// What came and what did not, since the camera was opened.
struct GigeCounts {
  std::int64_t images = 0;  ///< complete
  /// With packets missing, or for which no buffer was free; none from before the first take().
  std::int64_t lost_images = 0;
  std::int64_t missing_packets = 0;  ///< as far as noticed
  std::int64_t resent_packets = 0;   ///< asked for again
};

class GigeCamera {
 public:
  /// Opens, takes control and sets up; does not stream yet. Throws DeviceError that names the
  /// device and what it refused.
  explicit GigeCamera(const GigeCameraOptions& options);
  /// Stops streaming and gives control back; a camera that does not answer is left as it is.
  ~GigeCamera();
  GigeCamera(const GigeCamera&) = delete;
  GigeCamera& operator=(const GigeCamera&) = delete;

  [[nodiscard]] const RegionLimits& limits() const;
  [[nodiscard]] double exposure() const;  ///< as the camera set it [s]

  // Settings: one thread at a time. Each throws DeviceError.
  /// Region from the next exposure on. A new size stops and starts a running stream.
  void setRegion(const Window& region);
  [[nodiscard]] const Window& region() const;
  void setFrameRate(double rate_hz);  ///< of a free-running camera; [Hz]
  void start();
  void stop();
  void fire();  ///< the software trigger

  // Images: one thread, which may be another one.
  /// The next complete image; waits up to `timeout_s` [s]. Throws DeviceError once control of the
  /// camera was lost.
  [[nodiscard]] std::optional<GigeImage> take(double timeout_s);
  [[nodiscard]] GigeCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ringhook
