#include "calib/wizard/place_delays.h"

#include <algorithm>

#include "calib/wizard/place_plate.h"
#include "camera/recording_folder.h"
#include "camera/replay_camera.h"
#include "camera/sequence.h"
#include "camera/sequence_recorder.h"
#include "camera/stereo_camera.h"
#include "core/error.h"
#include "cycle/arm_motion.h"
#include "cycle/hook_sight.h"
#include "robot/arm.h"
#include "robot/limiter.h"
#include "robot/rx60/kinematics.h"

namespace ringhook {
namespace {

constexpr double kFindRate = 5.0;           // of full images until the plate is found [Hz]
constexpr double kWatchRate = 50.0;         // of windows afterwards [Hz]
constexpr double kFindPatience = 10.0;      // for the images of that [s],
constexpr int kFindFrames = 10;             // and for the plate in them
constexpr double kLead = 0.3;               // standing still in sight before and after [s]
constexpr double kGainPerS = 3.0;           // of what the arm lacks of the wiggle
constexpr double kWayStep = 0.02;           // [s]
constexpr int kMissesLost = 5;              // frames in a row
constexpr std::size_t kFramesWaiting = 64;  // for the disk

/// One wiggle, watched.
class WatchedWiggle {
 public:
  WatchedWiggle(const PlaceDevices& devices, const CellConfig& cell, const StereoRig& rig,
                const TagPlate& plate, const DelayStep& step)
      : devices_(devices),
        step_(step),
        watch_(rig, plate),
        arm_(armOf(rig)),
        limiter_(limiterSettings(cell.arm, arm_)) {
    record_.motion.fMc1 = requireRobotCamera(rig, cell.rig);
    record_.stamps_are_mid_exposure = devices.stamps_are_mid_exposure;
    record_.command_delay_s = devices.arm.commandDelay();
    lead_s_ = cell.arm.delay_s + record_.command_delay_s + 0.5 * kArmPeriod;
  }

  void keepIn(std::unique_ptr<SequenceRecorder> recorder) { recorder_ = std::move(recorder); }

  /// Whether both cameras see the plate, the arm at rest; the reason if not. From then on the
  /// cameras read what it will pass through.
  std::string find(const WiggleOptions& options) {
    std::string reason = "no images came";
    aim(kFindRate);
    const Time begin = devices_.arm.waitState().time;
    int frames = 0;
    for (Time now = begin; now - begin < kFindPatience && frames < kFindFrames;
         now = devices_.arm.waitState().time) {
      step_(0.0, "looking for the plate");
      while (const std::optional<StereoFrame> frame = devices_.camera.grab(0.0)) {
        if (frame->time < begin) {
          continue;  // of the rest before, which nobody fetched: of next to nothing
        }
        const Outcome<HookView> view = watch_.see(*frame);
        ++frames;
        if (view) {
          watch_.watchOver(wayOf(*view, devices_.arm.waitState().position, options));
          aim(kWatchRate);
          return {};
        }
        reason = view.reason();
      }
    }
    return reason;
  }

  WiggleRecord run(const WiggleOptions& options) {
    ArmState state = devices_.arm.waitState();
    const Wiggle wiggle(state.position, options);
    begin_ = state.time + kLead;
    last_seen_ = state.time;
    const double end = wiggle.seconds() + kLead;
    while (state.time - begin_ < end) {
      const double t = state.time - begin_;
      step_(std::clamp(t / end, 0.0, 1.0), std::to_string(record_.motion.plate.size()) + " sights");
      command(state, wiggle.at(t + lead_s_));
      state = devices_.arm.waitState();
      if (!state.motion_possible) {
        throw DeviceError("the arm reports that no motion is possible");
      }
      note(state);
      takeFrames();
      const double unseen_s = state.time - last_seen_;
      if ((misses_ >= kMissesLost && unseen_s > kPlateLost) || unseen_s > kPlateLostAtLatest) {
        throw Error("the cameras lost sight of the gripper's plate (" + lost_ +
                    "): the arm was stopped; the belt has to stand still and nothing may pass in "
                    "front of the "
                    "plate");
      }
    }
    devices_.arm.commandVelocity(JointVector::Zero());
    if (recorder_) {
      recorder_->close();
    }
    return std::move(record_);
  }

 private:
  /// Poses of the plate in the left camera during the wiggle, from where it is seen at rest.
  [[nodiscard]] std::vector<Pose> wayOf(const HookView& view, const JointVector& rest,
                                        const WiggleOptions& options) const {
    const Pose c1Mf = record_.motion.fMc1.inverse();
    const Pose eMo = rx60::forward(arm_, rest).inverse() * record_.motion.fMc1 * view.c1Mo_start;
    const Wiggle wiggle(rest, options);
    std::vector<Pose> way;
    for (double t = 0.0; t <= wiggle.seconds(); t += kWayStep) {
      way.push_back(c1Mf * rx60::forward(arm_, wiggle.at(t).position) * eMo);
    }
    return way;
  }

  void aim(double rate_hz) {
    devices_.camera.setWindows(watch_.windows()[0], watch_.windows()[1]);
    devices_.camera.setFrameRate(rate_hz);
  }

  void command(const ArmState& state, const JointSample& wanted) {
    // What the arm lacks is judged against where it was to be when the state was sampled.
    const JointVector missing = wanted.position - lead_s_ * wanted.velocity - state.position;
    const JointVector velocity =
        limiter_.limit(wanted.velocity + kGainPerS * missing, state.position).velocity;
    devices_.arm.commandVelocity(velocity);
    record_.sent.push_back({state.time, velocity});
  }

  void note(const ArmState& state) {
    record_.states.push_back(state);
    const Pose fMe = rx60::forward(arm_, state.position);
    record_.motion.flange.push_back({state.time, fMe});
    if (recorder_) {
      recorder_->addRobot(state.time, state.position, fMe);
    }
  }

  void takeFrames() {
    while (std::optional<StereoFrame> frame = devices_.camera.grab(0.0)) {
      if (const std::optional<double> late = devices_.lateness_s()) {
        record_.lateness_s.push_back(*late);
      }
      ++record_.frames;
      const Outcome<HookView> view = watch_.see(*frame);
      if (view) {
        last_seen_ = std::max(last_seen_, frame->time);
        misses_ = 0;
        record_.motion.plate.push_back(*view);
      } else {
        lost_ = view.reason();
        ++misses_;
      }
      if (recorder_) {
        recorder_->addFrame(std::move(*frame), std::nullopt);
      }
    }
  }

  const PlaceDevices& devices_;
  const DelayStep& step_;
  PlateWatch watch_;
  rx60::Geometry arm_;
  Limiter limiter_;
  double lead_s_ = 0.0;
  Time begin_;
  Time last_seen_;
  int misses_ = 0;  // since then
  std::string lost_ = "no images came";
  WiggleRecord record_;
  std::unique_ptr<SequenceRecorder> recorder_;
};

/// Opens the folder that keeps a wiggle. Pictures that this machine is too slow to store are left
/// out, except in virtual time, which waits.
std::unique_ptr<SequenceRecorder> recorderFor(const KeptWiggle& keep, const CalibrationPlace& place,
                                              const StereoRig& rig) {
  if (keep.folder.empty()) {
    return nullptr;
  }
  SequenceInfo info;
  info.name = "wiggle for calibrate time";
  info.rate_hz = kWatchRate;
  info.target = keep.target;
  info.notes = place.name() + "; times are stamps as they came, no delay taken off";
  return std::make_unique<SequenceRecorder>(
      std::make_unique<SequenceWriter>(keep.folder, info, rig), kFramesWaiting,
      place.canHoldBoard() ? SequenceRecorder::WhenFull::kWait
                           : SequenceRecorder::WhenFull::kLeaveOut);
}

/// Leaves neither motion nor a full stream of images behind.
struct QuietCamera {
  StereoCamera& camera;
  ~QuietCamera() {
    try {
      camera.setFrameRate(kFindRate);
    } catch (const Error&) {
      return;  // the camera is lost: there is nothing left to slow down
    }
  }
};

}  // namespace

Outcome<WiggleRecord> recordWiggle(CalibrationPlace& place, const CellConfig& cell,
                                   const StereoRig& rig, const TagPlate& plate,
                                   const WiggleOptions& options, const DelayStep& step,
                                   const KeptWiggle& keep) {
  if (!keep.folder.empty()) {
    checkRecordingFolder(keep.folder, false);
  }
  const PlaceDevices* devices = place.devices();
  if (devices == nullptr) {
    return Refusal{"no arm and cameras here: a stored sequence is read instead"};
  }
  const Outcome<Pose> standby = place.moveJoints(cell.arm.standby_rad);
  if (!standby) {
    return Refusal{"the way to the standby pose: " + standby.reason()};
  }
  const QuietCamera quiet{devices->camera};
  try {
    WatchedWiggle wiggle(*devices, cell, rig, plate, step);
    if (const std::string reason = wiggle.find(options); !reason.empty()) {
      return Refusal{"the gripper's plate is not seen at the standby pose: " + reason};
    }
    wiggle.keepIn(recorderFor(keep, place, rig));
    return wiggle.run(options);
  } catch (...) {
    devices->arm.stop();
    throw;
  }
}

WiggleRecord readWiggle(const std::filesystem::path& folder, const StereoRig& rig,
                        const TagPlate& plate, const DelayStep& step) {
  Sequence sequence = openSequence(folder);
  if (sequence.robot.size() < 10) {
    throw InputError(folder.string() + ": expected robot.csv with the arm's states");
  }
  WiggleRecord record;
  record.motion.fMc1 = requireRobotCamera(rig, folder / "rig.yaml");
  record.stamps_are_mid_exposure = true;  // what frames.csv means
  for (const StampedArm& row : sequence.robot) {
    record.motion.flange.push_back({row.time, row.fMe});
  }
  PlateWatch watch(rig, plate);
  ReplayStereoCamera camera(std::move(sequence), rig.left.width, rig.left.height);
  const auto frames = static_cast<double>(std::max<std::size_t>(1, camera.expectedFrames()));
  while (const std::optional<StereoFrame> frame = camera.grab(0.0)) {
    step(record.frames++ / frames, std::to_string(record.motion.plate.size()) + " sights");
    if (Outcome<HookView> view = watch.see(*frame)) {
      record.motion.plate.push_back(*view);
    }
  }
  return record;
}

}  // namespace ringhook
