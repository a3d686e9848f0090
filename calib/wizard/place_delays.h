#pragma once

/// \file
/// Delays of a cell's cameras and arm: the arm wiggles (place_wiggle.h), the cameras watch the
/// plate on its gripper through windows that hold its whole way, and the one motion is laid over
/// the other (calib/solve/time_delay.h, where it also stands what can be known and what cannot).
///
/// Safety: the motion is small and begins where the arm waits for hooks. A plate that is not seen
/// for kPlateLost, a device that fails, a limit, Ctrl-C: whatever is thrown, the arm is stopped
/// first.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calib/solve/time_delay.h"
#include "calib/wizard/place.h"
#include "calib/wizard/place_wiggle.h"
#include "rig/stereo_rig.h"
#include "tracking/tag_plate.h"

namespace ringhook {

inline constexpr double kPlateLost = 0.3;  ///< without a sight for longer the wiggle ends [s];
/// cameras that deliver less than five pictures in it are waited for until then [s]
inline constexpr double kPlateLostAtLatest = 1.0;

/// What was seen and told during a wiggle.
struct WiggleRecord {
  PlateMotion motion;
  std::vector<SentVelocity> sent;
  std::vector<ArmState> states;
  std::vector<double> lateness_s;        ///< of frames: arrival minus mid-exposure, where known
  int frames = 0;                        ///< during the motion, seen or not
  bool stamps_are_mid_exposure = false;  ///< see PlaceDevices
  double command_delay_s = 0.0;          ///< Arm::commandDelay()
};

/// A sequence folder to keep what was seen and told, for readWiggle().
struct KeptWiggle {
  std::filesystem::path folder;  ///< new or empty; empty path: nothing is kept
  std::filesystem::path target;  ///< the plate's marker.yaml, copied into it
};

/// Told between steps: the part done (0 to 1) and a short state; may throw.
using DelayStep = std::function<void(double fraction, const std::string& note)>;

/// Moves to the cell's standby pose, looks for the plate and wiggles. Refuses, with the arm at
/// rest: no devices here, no motion confirmed, way blocked, plate not seen by both cameras. Throws
/// Error when the plate is lost on the way or the disk refuses, InputError for a folder in use,
/// DeviceError, and what `step` throws.
Outcome<WiggleRecord> recordWiggle(CalibrationPlace& place, const CellConfig& cell,
                                   const StereoRig& rig, const TagPlate& plate,
                                   const WiggleOptions& options, const DelayStep& step,
                                   const KeptWiggle& keep = {});

/// The same from a stored sequence with robot.csv: its images are searched for the plate. Throws
/// InputError for a sequence without robot.csv or whose rig lacks fMc1.
WiggleRecord readWiggle(const std::filesystem::path& folder, const StereoRig& rig,
                        const TagPlate& plate, const DelayStep& step);

/// A delay, and how sure it is.
struct KnownDelay {
  double value_s = 0.0;
  double sigma_s = 0.0;  ///< standard deviation
};

enum class DelayGrade { ok, bad };

struct DelayReport {
  TimeOffset offset;                      ///< what the motion tells: robot minus camera
  std::optional<KnownDelay> robot;        ///< sampling to message stamp; nothing: could not be told
  std::optional<KnownDelay> camera;       ///< mid-exposure to arrival; likewise
  std::optional<ResponseDelay> response;  ///< of commands; nothing without commands
  std::optional<double> arm_delay_s;  ///< for the cell file's arm.delay_ms: response minus protocol
  int frames = 0;
  DelayGrade grade = DelayGrade::bad;
  std::string sentence;  ///< why
};

/// \param told the rig before; a delay that cannot be known apart is taken from it. Refuses as
/// findTimeOffset does.
Outcome<DelayReport> delaysOf(const WiggleRecord& record, const StereoRig& told);

/// The rig with the delays that were found.
StereoRig withDelays(StereoRig rig, const DelayReport& report);

}  // namespace ringhook
