#include "calib/wizard/place_devices.h"
#include "core/error.h"
#include "cycle/network_devices.h"

namespace ringhook {
namespace {

class NetworkPlace final : public DevicePlace {
 public:
  /// \param watched the same as `camera`, for what only it can tell.
  NetworkPlace(const CellConfig& cell, std::unique_ptr<Rx60Arm> arm,
               std::unique_ptr<StereoCamera> camera, const AravisStereoCamera& watched)
      : DevicePlace(cell, std::move(arm), std::move(camera), cell.devices.cameras.host_clock) {
    const bool host_clock = cell.devices.cameras.host_clock;
    const double half_exposure_s = 0.5 * cell.devices.cameras.exposure_s;
    tellLateness([&watched, host_clock, half_exposure_s]() -> std::optional<double> {
      if (!host_clock) {
        return std::nullopt;
      }
      return watched.counts().lateness_s - half_exposure_s;  // counted from the exposure's start
    });
  }

  [[nodiscard]] std::string name() const override { return "cell on a network: " + cell().name; }
  [[nodiscard]] bool needsConfirmation() const override { return !confirmed_; }
  void confirmMotion() override {
    arm().rearm();
    confirmed_ = true;
  }

 private:
  bool confirmed_ = false;
};

}  // namespace

std::unique_ptr<CalibrationPlace> openNetworkPlace(const CellConfig& cell) {
  if (cell.devices.kind != DeviceKind::kNetwork) {
    throw InputError(cell.file.string() +
                     ": field devices.kind: expected network for devices on a network");
  }
  auto camera = openCameras(cell, 0.0);
  const AravisStereoCamera& watched = *camera;
  auto arm = openArm(cell, Rx60Arm::Needs::kState);
  return std::make_unique<NetworkPlace>(cell, std::move(arm), std::move(camera), watched);
}

}  // namespace ringhook
