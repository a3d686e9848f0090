#include "cycle/cell_config.h"

#include "core/angle.h"
#include "core/yaml_fields.h"

namespace ringhook {
namespace {

HookConfig readHook(YamlFields fields) {
  HookConfig hook;
  hook.plate = fields.path("plate");
  hook.model = fields.path("model");
  hook.pivot_o = fields.vector("pivot_o_m", 3);
  hook.pendulum_length_m = fields.number("pendulum_length_m", 0.01, 10.0);
  hook.swing_max_rad = fields.number("swing_max_deg", 0.0, 45.0) * kDegree;
  fields.refuseUnknown();
  return hook;
}

BeltConfig readBelt(YamlFields fields) {
  BeltConfig belt;
  belt.pivot_start_f = fields.vector("pivot_start_f_m", 3);
  const Eigen::Vector3d direction = fields.vector("direction_f", 3);
  if (direction.norm() < 1e-6) {
    fields.refuse("direction_f", "a direction, not zeros");
  }
  belt.direction_f = direction.normalized();
  belt.search_from_m = fields.number("search_from_m");
  belt.search_to_m = fields.number("search_to_m", belt.search_from_m);
  belt.pick_from_m = fields.number("pick_from_m");
  belt.pick_to_m = fields.number("pick_to_m", belt.pick_from_m);
  fields.refuseUnknown();
  return belt;
}

ArmConfig readArm(YamlFields fields) {
  ArmConfig arm;
  const Eigen::Vector3d position = fields.vector("ring_e_m", 3);
  const Eigen::Vector4d q = fields.vector("ring_e_quaternion_xyzw", 4);
  if (q.norm() < 0.5) {
    fields.refuse("ring_e_quaternion_xyzw", "a unit quaternion");
  }
  arm.eMr = makePose(position, Eigen::Quaterniond(q[3], q[0], q[1], q[2]));
  arm.load_rad = fields.vector("load_deg", 6) * kDegree;
  arm.standby_rad = fields.vector("standby_deg", 6) * kDegree;
  arm.speed_fraction = fields.number("speed_fraction", 0.01, 1.0);
  arm.gripper_time_s = fields.number("gripper_time_s", 0.0, 10.0);
  arm.delay_s = fields.number("delay_ms", 0.0, 200.0) * 1e-3;
  if (fields.has("gripper_plate")) {
    arm.gripper_plate = fields.path("gripper_plate");
  }
  fields.refuseUnknown();
  return arm;
}

TaskConfig readTask(YamlFields fields) {
  TaskConfig task;
  task.gain_per_s = fields.number("gain_per_s", 0.1, 50.0);
  task.hover_m = fields.number("hover_mm", 5.0, 500.0) * 1e-3;
  task.tip_o = fields.vector("tip_o_m", 3);
  task.release_o = fields.vector("release_o_m", 3);
  task.retreat_o = fields.vector("retreat_o_m", 3);
  task.path_speed_m_s = fields.number("path_speed_m_s", 0.001, 1.8);
  task.approach_speed_m_s = fields.number("approach_speed_m_s", 0.001, 1.8);
  task.align_tolerance_m = fields.number("align_tolerance_mm", 0.01, 100.0) * 1e-3;
  task.abort_tolerance_m = fields.number("abort_tolerance_mm", 0.01, 100.0) * 1e-3;
  task.align_dwell_s = fields.number("align_dwell_s", 0.0, 60.0);
  task.align_timeout_s = fields.number("align_timeout_s", 0.1, 60.0);
  task.watch_s = fields.number("watch_s", 0.0, 60.0);
  task.hook_timeout_s = fields.number("hook_timeout_s", 0.0, 3600.0);
  fields.refuseUnknown();
  return task;
}

VisionConfig readVision(YamlFields fields) {
  VisionConfig vision;
  vision.rate_hz = fields.number("rate_hz", 1.0, 1000.0);
  vision.search_rate_hz = fields.number("search_rate_hz", 0.1, 1000.0);
  vision.warm_up_s = fields.number("warm_up_s", 0.0, 60.0);
  vision.stale_after_s = fields.number("stale_after_ms", 1.0, 5000.0) * 1e-3;
  vision.lost_after_frames = fields.integer("lost_after_frames", 1, 1000);
  vision.transport_delay_s = fields.number("transport_delay_ms", 0.0, 1000.0) * 1e-3;
  if (fields.has("window_lag_frames")) {
    vision.window_lag_frames = fields.integer("window_lag_frames", 1, 10);
  }
  fields.refuseUnknown();
  return vision;
}

CameraDevices readCameras(YamlFields fields) {
  CameraDevices cameras;
  cameras.left = fields.text("left");
  cameras.right = fields.text("right");
  if (cameras.left == cameras.right) {
    fields.refuse("right", "another camera than the left one");
  }
  cameras.host_clock = fields.choice("clock", {"own", "host"}) == 1;
  cameras.trigger = fields.text("trigger");
  cameras.exposure_s = fields.number("exposure_us", 1.0, 1e6) * 1e-6;
  if (fields.has("gain")) {
    cameras.gain = fields.number("gain", -100.0, 100.0);
  }
  cameras.packet_bytes = fields.integer("packet_bytes", 576, 16000);
  fields.refuseUnknown();
  return cameras;
}

ControllerDevice readController(YamlFields fields) {
  ControllerDevice arm;
  arm.address = fields.text("address");
  const auto port = [&fields](const char* key, int& value) {
    if (fields.has(key)) {
      value = fields.integer(key, 1, 65535);
    }
  };
  port("motion_port", arm.motion_port);
  port("system_port", arm.system_port);
  port("state_port", arm.state_port);
  port("io_port", arm.io_port);
  arm.gripper_module = fields.integer("gripper_module", 0, 1000);
  arm.gripper_pin = fields.integer("gripper_pin", 0, 1000);
  arm.gripper_closes_on = fields.choice("gripper_closes", {"off", "on"}) == 1;
  fields.refuseUnknown();
  return arm;
}

DeviceConfig readDevices(YamlFields fields) {
  DeviceConfig devices;
  constexpr DeviceKind kKinds[] = {DeviceKind::kSimulated, DeviceKind::kNetwork};
  devices.kind = kKinds[fields.choice("kind", {"simulated", "network"})];
  if (devices.kind == DeviceKind::kSimulated) {
    devices.scenario = fields.path("scenario");
  } else {
    if (fields.has("scenario")) {
      devices.scenario = fields.path("scenario");
    }
    devices.cameras = readCameras(fields.section("cameras"));
    devices.arm = readController(fields.section("arm"));
  }
  fields.refuseUnknown();
  return devices;
}

}  // namespace

CellConfig loadCellConfig(const std::filesystem::path& file) {
  YamlFields fields = YamlFields::open(file);
  CellConfig cell;
  cell.file = file;
  cell.name = fields.text("name");
  cell.rig = fields.path("rig");
  cell.devices = readDevices(fields.section("devices"));
  cell.hook = readHook(fields.section("hook"));
  cell.belt = readBelt(fields.section("belt"));
  cell.arm = readArm(fields.section("arm"));
  cell.task = readTask(fields.section("task"));
  cell.vision = readVision(fields.section("vision"));
  fields.refuseUnknown();
  return cell;
}

}  // namespace ringhook
