#pragma once

/// \file
/// The operator's job: hang a ring on each of so many passing hooks. On the simulated cell it runs
/// in virtual time, is judged by physics, and everything it returns is a function of the cell file,
/// the scenario and the seed. On a cell with devices on a network it runs in real time
/// (live_run.h). What was finished is kept when it is interrupted.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "camera/aravis_stereo_camera.h"
#include "core/thread_priority.h"
#include "cycle/hook_sight.h"
#include "cycle/task_control.h"
#include "evaluation/servo_witness.h"
#include "robot/rx60/link_settings.h"

namespace ringhook {

/// How the loop reaches the simulated arm.
enum class ArmLink {
  kDirect,  ///< in process
  kRx60,    ///< through the RX60's client, its protocol and the simulated controller
};

struct ServoJob {
  std::filesystem::path cell_file;
  std::string scenario;  ///< name beside the cell's own scenario; empty for the cell's own
  TrackerKind tracker = TrackerKind::kMarker;
  ArmLink arm_link = ArmLink::kDirect;
  int cycles = 3;  ///< hooks, one attempt each
  std::uint64_t seed = 1;
  std::filesystem::path out;  ///< folder for the sequence and the picture
};

/// One hook's attempt, as the loop and as physics saw it.
struct ServoAttempt {
  AttemptResult loop;
  std::optional<AttemptTruth> truth;  ///< simulated cell only
};

/// How the devices of a network did.
struct LiveReport {
  AravisCounts cameras;
  rx60::LinkReport arm;
  ThreadPriority link_priority = ThreadPriority::kOrdinary;  ///< of the thread that speaks with it
  std::int64_t frames_passed_over = 0;  ///< a newer one had come when vision got to them
  Statistics frame_interval_s;          ///< between frames while a hook is tracked
};

struct ServoReport {
  std::string cell;
  std::string scenario;
  std::vector<ServoAttempt> attempts;  ///< finished ones
  std::optional<LiveReport> live;      ///< of a cell on a network
  LoopStatistics statistics;
  bool interrupted = false;
  std::string failure;             ///< of a device on a network, in words; empty if none
  std::filesystem::path sequence;  ///< recorded cycle; empty if none
  std::filesystem::path picture;   ///< of the hanging ring; empty if none hung
};

/// Told after every arm state: attempt counted from 0, its phase, virtual time [s].
using ServoProgress = std::function<void(int attempt, TaskPhase phase, double time_s)>;
/// Told after every attempt.
using AttemptDone = std::function<void(int attempt, const ServoAttempt&)>;

/// Throws InputError for bad files, DeviceError for a device that cannot be opened. An interruption
/// and the failure of a device at work are no errors here: the arm was stopped, the report says so
/// and holds what was finished.
ServoReport runServo(const ServoJob& job, const std::atomic<bool>& stop,
                     const ServoProgress& progress, const AttemptDone& attempt_done);

}  // namespace ringhook
