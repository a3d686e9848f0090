#include "evaluation/live_run.h"

#include <memory>
#include <optional>
#include <utility>

#include "core/error.h"
#include "cycle/network_devices.h"
#include "cycle/servo_loop.h"
#include "cycle/vision_thread.h"
#include "rig/stereo_rig.h"
#include "robot/rx60/kinematics.h"

namespace ringhook {
namespace {

/// Counts on both threads, each in figures of its own, and tells how far the job is.
class LiveObserver : public LoopObserver {
 public:
  explicit LiveObserver(const ServoProgress& progress)
      : progress_(progress), limits_(rx60::limits()) {}

  void startAttempt(int attempt) { attempt_ = attempt; }

  void onFrame(const StereoFrame& frame, const VisionReport& report, double age_s) override {
    countFrame(report, age_s, vision_);
    const bool tracked = report.state != VisionState::kSearching;
    if (tracked && last_frame_) {
      interval_s_.add(frame.time - *last_frame_);
    }
    last_frame_ = tracked ? std::optional(frame.time) : std::nullopt;
  }
  void onCommand(const ArmState& state, const TaskCommand& command) override {
    countCommand(state, command, limits_, control_);
    progress_(attempt_, command.phase, state.time.seconds());
  }

  /// Once vision's thread has ended.
  [[nodiscard]] LoopStatistics statistics() const {
    LoopStatistics all = vision_;
    all.merge(control_);
    return all;
  }
  /// Likewise; between frames while a hook is tracked [s].
  [[nodiscard]] const Statistics& frameInterval() const { return interval_s_; }

 private:
  const ServoProgress& progress_;
  JointLimits limits_;
  int attempt_ = 0;
  LoopStatistics vision_;  // of vision's thread, as the next two
  Statistics interval_s_;
  std::optional<Time> last_frame_;
  LoopStatistics control_;  // of the control side
};

/// The cell with the time from a state's stamp until the answer acts. A stamp is `robot_delay`
/// later than the instant that it stands for.
CellConfig withDelays(CellConfig cell, const Arm& arm, const StereoRig& rig) {
  cell.arm.delay_s += arm.commandDelay() - rig.robot_delay_s;
  return cell;
}

void runAttempts(const ServoJob& job, VisionSide& vision, Arm& arm, TaskControl& task,
                 LiveObserver& observer, const std::atomic<bool>& stop,
                 const AttemptDone& attempt_done, ServoReport& report) {
  for (int i = 0; i < job.cycles; ++i) {
    observer.startAttempt(i);
    ServoAttempt attempt;
    attempt.loop = runAttempt(vision, arm, task, observer, stop);
    report.attempts.push_back(attempt);
    attempt_done(i, attempt);
  }
}

}  // namespace

ServoReport runLiveServo(const ServoJob& job, const CellConfig& cell, const std::atomic<bool>& stop,
                         const ServoProgress& progress, const AttemptDone& attempt_done) {
  const StereoRig rig = loadRig(cell.rig);
  ServoReport report;
  report.cell = cell.name;
  report.live.emplace();
  VisionStep vision(cell, rig, job.tracker);
  const std::unique_ptr<AravisStereoCamera> camera = openCameras(cell, rig.camera_delay_s);
  const std::unique_ptr<Rx60Arm> arm = openArm(cell);
  TaskControl task(withDelays(cell, *arm, rig), armOf(rig));
  LiveObserver observer(progress);
  try {
    VisionThread thread(*camera, vision, observer);
    runAttempts(job, thread, *arm, task, observer, stop, attempt_done, report);
    report.live->frames_passed_over = thread.passedOver();
  } catch (const Interrupted&) {
    report.interrupted = true;
  } catch (const DeviceError& e) {
    report.failure = e.what();
  }
  report.statistics = observer.statistics();
  report.live->frame_interval_s = observer.frameInterval();
  report.live->cameras = camera->counts();
  report.live->arm = arm->report();
  report.live->link_priority = arm->priority();
  return report;
}

}  // namespace ringhook
