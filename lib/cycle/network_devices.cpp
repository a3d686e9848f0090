#include "cycle/network_devices.h"

#include "robot/rx60/tcp_port.h"

namespace ringhook {
namespace {

/// A busy host that simulates the cell takes longer than a controller's second [s].
constexpr double kFirstState = 10.0;

GigeCameraOptions cameraOptions(const CameraDevices& devices, const std::string& device) {
  GigeCameraOptions options;
  options.device = device;
  options.exposure_s = devices.exposure_s;
  options.gain = devices.gain;
  options.packet_bytes = devices.packet_bytes;
  if (devices.trigger == "software") {
    options.trigger = CameraTrigger::kSoftware;
  } else if (devices.trigger != "free-run") {
    options.trigger = CameraTrigger::kLine;
    options.line = devices.trigger;
  }
  return options;
}

}  // namespace

std::unique_ptr<AravisStereoCamera> openCameras(const CellConfig& cell, double delay_s) {
  const CameraDevices& devices = cell.devices.cameras;
  AravisOptions options;
  options.left = cameraOptions(devices, devices.left);
  options.right = cameraOptions(devices, devices.right);
  options.clock = devices.host_clock ? CameraClock::kHost : CameraClock::kOwn;
  options.rate_hz = cell.vision.search_rate_hz;
  options.delay_s = delay_s;
  return std::make_unique<AravisStereoCamera>(options);
}

std::unique_ptr<Rx60Arm> openArm(const CellConfig& cell, Rx60Arm::Needs needs) {
  const ControllerDevice& device = cell.devices.arm;
  rx60::ControllerAddress address;
  address.host = device.address;
  address.motion_port = static_cast<std::uint16_t>(device.motion_port);
  address.system_port = static_cast<std::uint16_t>(device.system_port);
  address.state_port = static_cast<std::uint16_t>(device.state_port);
  address.io_port = static_cast<std::uint16_t>(device.io_port);
  rx60::LinkSettings settings;
  settings.gripper_module = device.gripper_module;
  settings.gripper_pin = device.gripper_pin;
  settings.gripper_closes_on = device.gripper_closes_on;
  settings.first_state_s = kFirstState;
  settings.limiter.tool_e = cell.arm.eMr.translation();
  return std::make_unique<Rx60Arm>(std::make_unique<rx60::TcpPort>(address), settings,
                                   Rx60Arm::Runs::kOnItsOwnThread, needs);
}

}  // namespace ringhook
