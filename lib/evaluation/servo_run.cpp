#include "evaluation/servo_run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/error.h"
#include "cycle/servo_loop.h"
#include "evaluation/cell_devices.h"
#include "evaluation/live_run.h"
#include "evaluation/truth_log.h"
#include "sim/nominal_rig.h"
#include "sim/scenario.h"
#include "sim/sim_arm.h"
#include "sim/sim_stereo_camera.h"
#include "sim/wired_sim_arm.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

/// Hooks that one simulated belt carries; a longer job goes on with a fresh belt.
constexpr int kHooksPerBelt = 6;
constexpr double kTruthPeriod = 0.01;  // [s]

/// Passes on what the witness sees, and tells how far the job is.
class ProgressObserver : public LoopObserver {
 public:
  ProgressObserver(ServoWitness& witness, const ServoProgress& progress, int attempt)
      : witness_(witness), progress_(progress), attempt_(attempt) {}
  void onFrame(const StereoFrame& frame, const VisionReport& report, double age_s) override {
    witness_.onFrame(frame, report, age_s);
  }
  void onCommand(const ArmState& state, const TaskCommand& command) override {
    witness_.onCommand(state, command);
    progress_(attempt_, command.phase, state.time.seconds());
  }

 private:
  ServoWitness& witness_;
  const ServoProgress& progress_;
  int attempt_;
};

/// From the cameras' side and past the hook, with the ring low and the tag plate high in view.
Pose pictureView(const Eigen::Vector3d& ring_f) {
  const Eigen::Vector3d target_f = ring_f + Eigen::Vector3d(0.0, 0.0, 0.11);
  const Eigen::Vector3d eye_f = target_f + Eigen::Vector3d(0.66, 0.30, 0.06);
  const Eigen::Vector3d z = (target_f - eye_f).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Pose fMc = Pose::Identity();
  fMc.linear().col(0) = x;
  fMc.linear().col(1) = z.cross(x);
  fMc.linear().col(2) = z;
  fMc.translation() = eye_f;
  return fMc;
}

std::unique_ptr<Arm> makeArm(CellWorld& world, const ServoJob& job) {
  if (job.arm_link == ArmLink::kRx60) {
    return std::make_unique<WiredSimArm>(world, job.seed);
  }
  return std::make_unique<SimArm>(world);
}

/// The cell with the delay that the way of commanding its arm adds.
CellConfig withCommandDelay(CellConfig cell, const Arm& arm) {
  cell.arm.delay_s += arm.commandDelay();
  return cell;
}

/// One belt: the simulated devices, the loop's stages, the witness, and the job on it.
class Belt {
 public:
  Belt(const ServoJob& job, const CellConfig& cell, const Scenario& scenario, int first, int hooks)
      : job_(job),
        cell_(cell),
        told_rig_(loadRig(cell.rig)),
        true_rig_(disturbedRig(nominalRig(), job.seed, scenario.calibration)),
        world_(worldOptions(scenario, job, first, hooks)),
        arm_(makeArm(world_, job)),
        camera_(world_, true_rig_, simCameraOptions(cell, scenario)),
        vision_(cell, told_rig_, job.tracker),
        task_(withCommandDelay(cell, *arm_), armOf(told_rig_)),
        witness_(world_, requireRobotCamera(true_rig_, cell.rig), armOf(told_rig_),
                 cell.task.release_o, [this](const AttemptTruth& truth) { picture(truth); }),
        first_(first),
        hooks_(hooks),
        truth_log_(truthFolder(job, first), world_, true_rig_) {
    world_.every(kTruthPeriod, 0.0, [this](Time) { truth_log_.sample(); });
  }

  void run(const std::atomic<bool>& stop, const ServoProgress& progress,
           const AttemptDone& attempt_done, ServoReport& report) {
    report_ = &report;
    for (int i = first_; i < first_ + hooks_; ++i) {
      witness_.startAttempt(i == 0 ? recorder() : nullptr);
      ProgressObserver observer(witness_, progress, i);
      ServoAttempt attempt;
      VisionInTurn vision(camera_, vision_, observer);
      attempt.loop = runAttempt(vision, *arm_, task_, observer, stop);
      attempt.truth = witness_.attempt();
      witness_.endAttempt();
      report.attempts.push_back(attempt);
      attempt_done(i, attempt);
    }
    truth_log_.commit();
  }

  [[nodiscard]] const LoopStatistics& statistics() const { return witness_.statistics(); }

 private:
  static CellOptions worldOptions(const Scenario& scenario, const ServoJob& job, int first,
                                  int hooks) {
    CellOptions options = scenario.cell;
    options.seed = job.seed + static_cast<std::uint64_t>(first);
    options.hook.count = hooks;
    options.ring.count = hooks;
    return options;
  }

  /// Each belt begins at time zero, so each has its own: truth, truth-2, ...
  static fs::path truthFolder(const ServoJob& job, int first) {
    const int belt = 1 + first / kHooksPerBelt;
    return job.out / (belt == 1 ? "truth" : "truth-" + std::to_string(belt));
  }

  ServoWitness::OpenRecording recorder() {
    return [this](const Pose& c1Mo) {
      SequenceInfo info;
      info.name = "one cycle of " + cell_.name;
      info.rate_hz = cell_.vision.rate_hz;
      info.target = job_.tracker == TrackerKind::kMarker ? cell_.hook.plate : cell_.hook.model;
      info.c1Mo_start = c1Mo;
      info.notes = "simulated; truth.csv is c1Mo with the left camera where it truly stands";
      info.licence = "GPL-3.0-or-later";
      report_->sequence = job_.out / "sequence";
      return std::make_unique<SequenceWriter>(report_->sequence, info, told_rig_);
    };
  }

  /// The first ring that hangs is worth a picture.
  void picture(const AttemptTruth& truth_now) {
    if (!truth_now.hanging || !report_->picture.empty()) {
      return;
    }
    const fs::path file = job_.out / "hanging.png";
    const Pose fMr = truth(world_).rings[static_cast<std::size_t>(truth_now.ring)].fMr;
    camera_.savePicture(file, pictureView(fMr.translation()), 0.75, 1200, 900);
    report_->picture = file;
  }

  const ServoJob& job_;
  const CellConfig& cell_;
  StereoRig told_rig_;
  StereoRig true_rig_;
  CellWorld world_;
  std::unique_ptr<Arm> arm_;
  SimStereoCamera camera_;
  VisionStep vision_;
  TaskControl task_;
  ServoWitness witness_;
  ServoReport* report_ = nullptr;
  int first_;
  int hooks_;
  TruthLog truth_log_;  ///< last: a belt that cannot be built leaves no files
};

}  // namespace

ServoReport runServo(const ServoJob& job, const std::atomic<bool>& stop,
                     const ServoProgress& progress, const AttemptDone& attempt_done) {
  const CellConfig cell = loadCellConfig(job.cell_file);
  if (cell.devices.kind == DeviceKind::kNetwork) {
    return runLiveServo(job, cell, stop, progress, attempt_done);
  }
  const Scenario scenario = loadScenario(scenarioFile(cell, job.scenario));
  ServoReport report;
  report.cell = cell.name;
  report.scenario = scenario.name;
  for (int first = 0; first < job.cycles && !report.interrupted; first += kHooksPerBelt) {
    Belt belt(job, cell, scenario, first, std::min(kHooksPerBelt, job.cycles - first));
    try {
      belt.run(stop, progress, attempt_done, report);
    } catch (const Interrupted&) {
      report.interrupted = true;
    }
    report.statistics.merge(belt.statistics());
  }
  return report;
}

}  // namespace ringhook
