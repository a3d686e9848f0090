#pragma once

/// \file
/// The product's stereo camera: two GigE Vision cameras. Images are paired by the instant of their
/// exposure (stereo_pairing.h) on the host's steady clock, the one that the arm's states are
/// stamped with. Regions and rate are set on a thread of its own, so that a slow answer of a camera
/// never holds up an image; while several changes wait, the newest one counts. A camera that keeps
/// the region's size while it streams delivers somewhat more than the window asked for
/// (readout_region.h); every frame says what it was taken with.

#include <memory>
#include <string>

#include "camera/gige_camera.h"
#include "camera/stereo_camera.h"

namespace ringhook {

/// Which clock the cameras stamp their images with.
enum class CameraClock {
  kHost,  ///< the host's real time, by IEEE 1588 (PTP) with the host as master
  kOwn    ///< each its own: tied to the host's by the earliest arrivals
};

struct AravisOptions {
  GigeCameraOptions left;
  GigeCameraOptions right;
  CameraClock clock = CameraClock::kOwn;
  double rate_hz = 50.0;  ///< pairs per second at the start [Hz]
  double delay_s = 0.0;   ///< from mid-exposure to the earliest arrival, as calibrated; taken off
                          ///< the stamps of kOwn, needed for nothing with kHost [s]
};

/// What came and what did not, since the cameras were opened.
struct AravisCounts {
  std::int64_t pairs = 0;
  GigeCounts left;
  GigeCounts right;
  std::int64_t unpaired_left = 0;   ///< left images whose partner did not come
  std::int64_t unpaired_right = 0;  ///< likewise
  std::int64_t settling = 0;        ///< alone because the other camera was being restarted
  double lateness_s = 0.0;          ///< of the last image: from its stamp to its first packet [s]
};

class AravisStereoCamera : public StereoCamera {
 public:
  /// Opens both cameras and starts them with their full images. Throws DeviceError that names the
  /// camera and what is wrong with it.
  explicit AravisStereoCamera(const AravisOptions& options);
  ~AravisStereoCamera() override;

  [[nodiscard]] Window fullImage() const override;
  /// Returns at once; acts a few milliseconds later, or with a new size some tens.
  void setWindows(const Window& left, const Window& right) override;
  void setFrameRate(double rate_hz) override;
  [[nodiscard]] std::optional<StereoFrame> grab(double timeout_s) override;
  /// Cameras never end; one that is lost throws from grab().
  [[nodiscard]] bool finished() const override { return false; }

  /// From the thread that grabs.
  [[nodiscard]] AravisCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ringhook
