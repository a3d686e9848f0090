#pragma once

/// \file
/// A cell file: everything that the loop is told about its cell, and nothing that it must find out
/// by itself (where hooks are, how they swing, how fast the belt runs). YAML, units in the keys;
/// see doc/formats.md. Paths in the file are relative to the file.

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "core/joints.h"
#include "core/pose.h"

namespace ringhook {

/// What is known of the hook: its models and how it hangs.
struct HookConfig {
  std::filesystem::path plate;      ///< marker.yaml of the tag plate
  std::filesystem::path model;      ///< .cao of the edges
  Eigen::Vector3d pivot_o;          ///< axis of the swing in the hook frame [m]
  double pendulum_length_m = 0.35;  ///< nominal effective length I/(m d), from CAD
  double swing_max_rad = 0.1;       ///< largest swing that the task is made for
};

/// The conveyor: where pivots travel, where to look for them and where to work.
/// A travel is the distance along `direction_f` from `pivot_start_f`.
struct BeltConfig {
  Eigen::Vector3d pivot_start_f;  ///< a point on the line of the pivots [m]
  Eigen::Vector3d direction_f;    ///< unit vector of travel
  double search_from_m = 0.0;     ///< travel where a new hook is looked for, first
  double search_to_m = 0.0;       ///< and last
  double pick_from_m = 0.0;       ///< travel where the arm may meet the hook, first
  double pick_to_m = 0.0;         ///< and last; beyond it an unfinished insertion is given up
};

/// Arm, gripper and ring.
struct ArmConfig {
  Pose eMr = Pose::Identity();          ///< ring held in the flange
  JointVector load_rad;                 ///< where a ring is put into the gripper
  JointVector standby_rad;              ///< where the arm waits for a hook
  double speed_fraction = 0.5;          ///< of the nominal joint speeds, for coarse moves
  double gripper_time_s = 0.3;          ///< from the command until the jaws are open or closed
  double delay_s = 0.0;                 ///< from the state's instant until its command acts
  std::filesystem::path gripper_plate;  ///< marker.yaml of the plate on the gripper; may be empty
};

/// The task: timing and tolerances of following, lowering, releasing.
struct TaskConfig {
  double gain_per_s = 6.0;           ///< lambda of the pose task
  double hover_m = 0.045;            ///< of the ring above the tip before it is lowered
  Eigen::Vector3d tip_o;             ///< top of the tip's centreline [m]
  Eigen::Vector3d release_o;         ///< ring centre when it is let go [m]
  Eigen::Vector3d retreat_o;         ///< motion of the gripper after that [m]
  double path_speed_m_s = 0.08;      ///< peak, relative to the hook, while lowering
  double approach_speed_m_s = 0.25;  ///< peak, relative to the hook, before and after
  double align_tolerance_m = 0.003;  ///< ring against goal before it is lowered
  double abort_tolerance_m = 0.010;  ///< ring against goal while lowering; beyond it: abort
  double align_dwell_s = 0.2;        ///< how long the tolerance must hold
  double align_timeout_s = 4.0;      ///< then the attempt is aborted
  double watch_s = 2.2;              ///< how long the arm waits after the release
  double hook_timeout_s = 60.0;      ///< how long a hook is waited for
};

struct VisionConfig {
  double rate_hz = 50.0;             ///< while a hook is tracked
  double search_rate_hz = 5.0;       ///< while none is
  double warm_up_s = 1.0;            ///< of tracking before an estimate is acted upon
  double stale_after_s = 0.15;       ///< an estimate without a fix for longer is not acted upon
  int lost_after_frames = 10;        ///< consecutive misses until the hook counts as lost
  double transport_delay_s = 0.008;  ///< from mid-exposure to arrival, nominal
  int window_lag_frames = 1;         ///< exposures until a window asked for acts, at most
};

/// How the loop reaches its devices.
enum class DeviceKind {
  kSimulated,  ///< a simulated cell in the same process and in virtual time
  kNetwork     ///< GigE Vision cameras and an RX60 controller, real ones or `ringhook simulate`
};

/// Two GigE Vision cameras.
struct CameraDevices {
  std::string left;            ///< IPv4 address or serial number
  std::string right;           ///< likewise
  bool host_clock = false;     ///< stamps are the host's time (PTP); else each camera's own
  std::string trigger;         ///< free-run, software, or the name of a line
  double exposure_s = 0.0005;  ///< [s]
  std::optional<double> gain;  ///< in the cameras' unit; nothing: left as it is
  int packet_bytes = 1500;     ///< largest packet that the line carries whole
};

/// An RX60's controller with the VAL3 server.
struct ControllerDevice {
  std::string address = "127.0.0.1";  ///< name or numeric address
  int motion_port = 11000;
  int system_port = 11001;
  int state_port = 11002;
  int io_port = 11003;
  int gripper_module = 2;         ///< of the output that works the gripper
  int gripper_pin = 0;            ///< likewise
  bool gripper_closes_on = true;  ///< state of that output that closes it
};

struct DeviceConfig {
  DeviceKind kind = DeviceKind::kSimulated;
  std::filesystem::path scenario;  ///< of the simulated cell; empty for real devices
  CameraDevices cameras;           ///< of a network
  ControllerDevice arm;            ///< of a network
};

struct CellConfig {
  std::string name;
  std::filesystem::path file;  ///< where it was read
  std::filesystem::path rig;   ///< rig.yaml
  DeviceConfig devices;
  HookConfig hook;
  BeltConfig belt;
  ArmConfig arm;
  TaskConfig task;
  VisionConfig vision;
};

/// Reads a cell file. Throws InputError naming file, line and field for anything missing,
/// misspelt, ill-shaped or out of range.
CellConfig loadCellConfig(const std::filesystem::path& file);

}  // namespace ringhook
