#pragma once

/// \file
/// The stereo camera of the simulated cell. At each mid-exposure instant of the world both windows
/// are drawn and developed (camera_eye.h); the frame arrives a transport delay later. Frames wait
/// in a queue that keeps the newest 32. Deterministic: pixels depend on the world, the seed, the
/// frame number and the side; never on which windows were chosen.

#include <cstdint>
#include <filesystem>
#include <memory>

#include "camera/stereo_camera.h"
#include "core/pose.h"
#include "rig/stereo_rig.h"
#include "sim/sensor_noise.h"

namespace ringhook {

class CellWorld;

struct SimCameraOptions {
  double rate_hz = 50.0;             ///< pairs per second [Hz]
  double highest_rate_hz = 200.0;    ///< what the sensor can do [Hz]
  double transport_delay_s = 0.008;  ///< from mid-exposure to arrival [s]
  SensorOptions sensor;
};

class SimStereoCamera : public StereoCamera {
 public:
  /// \param true_rig where the cameras truly stand; needs both cameras and fMc1 (else Error).
  /// The world must outlive the camera. Throws DeviceError without OpenGL.
  SimStereoCamera(CellWorld& world, const StereoRig& true_rig,
                  const SimCameraOptions& options = {});
  ~SimStereoCamera() override;

  [[nodiscard]] Window fullImage() const override;
  void setWindows(const Window& left, const Window& right) override;
  void setFrameRate(double rate_hz) override;
  /// Never waits: a frame has arrived once the world's time has reached its arrival.
  [[nodiscard]] std::optional<StereoFrame> grab(double timeout_s) override;
  /// The simulated world never ends.
  [[nodiscard]] bool finished() const override;

  /// Colour picture of the scene as it stands, PNG or JPEG by the path's extension.
  /// \param fMc viewpoint (x right, y down, z forward). \param field_of_view horizontal [rad].
  /// Throws Error if the file cannot be written.
  void savePicture(const std::filesystem::path& path, const Pose& fMc, double field_of_view,
                   int width, int height);

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace ringhook
