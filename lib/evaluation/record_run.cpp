#include "evaluation/record_run.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "camera/recording_folder.h"
#include "camera/sequence_recorder.h"
#include "core/error.h"
#include "cycle/arm_motion.h"
#include "cycle/vision_step.h"
#include "evaluation/hook_past.h"
#include "evaluation/truth_log.h"
#include "robot/rx60/kinematics.h"

namespace ringhook {
namespace {

constexpr std::size_t kFramesWaiting = 32;
constexpr double kTruthPeriod = 0.02;      // of the truth log [s]
constexpr double kPngShare = 0.75;         // of a noisy image's bytes that PNG needs
constexpr double kBytesPerSecond = 200e3;  // of tables and truth

/// The cell as the job wants it.
CellConfig cellFor(const RecordJob& job) {
  CellConfig cell = loadCellConfig(job.cell_file);
  if (job.rate_hz) {
    cell.vision.rate_hz = *job.rate_hz;
  }
  return cell;
}

/// One recording from begin to end.
class Recording {
 public:
  Recording(const RecordJob& job, const RecordProgress& progress)
      : job_(job), progress_(progress), cell_(cellFor(job)), devices_(openCell(cell_, job.choice)) {
    if (job.follow) {
      vision_.emplace(cell_, devices_.told_rig, *job.follow);
    }
    if (devices_.world) {
      past_.emplace(*devices_.world, devices_.true_rig);
      devices_.world->every(kTruthPeriod, 0.0, [this](Time) {
        if (truth_log_) {
          truth_log_->sample();
        }
      });
    }
    report_.scenario = devices_.scenario;
  }

  RecordReport run(const std::atomic<bool>& stop) {
    aim();
    requireFreeSpace(job_.out, expectedBytes());
    while (!enough() && !stop.load() && !devices_.camera->finished()) {
      const ArmState state = devices_.arm->waitState();
      note(state.time);
      takeFrames();
      if (recorder_ && (!last_state_ || state.time > *last_state_)) {
        recorder_->addRobot(state.time, state.position,
                            rx60::forward(armOf(devices_.told_rig), state.position));
        last_state_ = state.time;
      }
    }
    report_.interrupted = !enough() && stop.load();
    close();
    return report_;
  }

  /// Ends the recording with what is whole; for a failure elsewhere.
  std::size_t keep() {
    try {
      close();
    } catch (const Error&) {
      truth_log_.reset();
    }
    return recorder_ ? recorder_->framesStored() : 0;
  }

 private:
  void aim() {
    StereoCamera& camera = *devices_.camera;
    const Window full = camera.fullImage();
    windows_ = vision_ ? vision_->windows() : job_.windows.value_or(std::array{full, full});
    for (Window& window : windows_) {
      window = intersect(window, full);
      if (window.empty()) {
        throw InputError("the window lies outside the image: expected one within " +
                         std::to_string(full.width) + "x" + std::to_string(full.height) + " px");
      }
    }
    camera.setWindows(windows_[0], windows_[1]);
    camera.setFrameRate(vision_ ? vision_->rateHz() : cell_.vision.rate_hz);
  }

  [[nodiscard]] std::uint64_t expectedBytes() const {
    double pixels = 0.0;
    for (const Window& window : windows_) {
      pixels += static_cast<double>(window.width) * window.height;
    }
    double pairs = job_.seconds * cell_.vision.rate_hz;
    if (job_.frames > 0) {
      pairs = std::min(pairs, static_cast<double>(job_.frames));
    }
    const double share = job_.image_format == "png" ? kPngShare : 1.0;
    const double seconds = pairs / cell_.vision.rate_hz;
    return static_cast<std::uint64_t>(pairs * pixels * share + seconds * kBytesPerSecond);
  }

  /// Seconds from the first stored frame to the last.
  [[nodiscard]] double recordedSeconds() const { return first_ ? *last_ - *first_ : 0.0; }

  [[nodiscard]] bool enough() const {
    // The last frame of a period begins one frame before its end; half a frame for rounding.
    const double last_begins = job_.seconds - 1.5 / cell_.vision.rate_hz;
    return (job_.frames > 0 && stored_ >= static_cast<std::size_t>(job_.frames)) ||
           (first_ && recordedSeconds() > last_begins);
  }

  void note(Time now) {
    begin_ = begin_.value_or(now);
    if (!recorder_ && vision_ && now - *begin_ > job_.wait_s) {
      throw Error("no hook came into view within " + std::to_string(std::lround(job_.wait_s)) +
                  " s; expected one between search_from_m and search_to_m of the cell file");
    }
    double fraction = recordedSeconds() / job_.seconds;
    if (job_.frames > 0) {
      fraction = std::max(fraction, static_cast<double>(stored_) / job_.frames);
    }
    progress_(fraction, recorder_ ? std::to_string(stored_) + " frames"
                                  : "looking for a hook, frame " + std::to_string(report_.before));
  }

  void takeFrames() {
    StereoCamera& camera = *devices_.camera;
    while (!enough()) {
      std::optional<StereoFrame> frame = camera.grab(0.0);
      if (!frame) {
        return;
      }
      if (!vision_) {
        store(std::move(*frame), std::nullopt);
        continue;
      }
      const VisionReport seen = vision_->process(*frame);
      camera.setWindows(vision_->windows()[0], vision_->windows()[1]);
      camera.setFrameRate(vision_->rateHz());
      if (seen.state != VisionState::kTracking || (!recorder_ && !seen.fix)) {
        ++report_.before;
        last_index_.reset();
      } else {
        store(std::move(*frame), seen.fix ? std::optional(seen.fix->c1Mo) : std::nullopt);
      }
    }
  }

  void store(StereoFrame frame, const std::optional<Pose>& c1Mo_seen) {
    const std::optional<Pose> c1Mo = past_ ? past_->c1Mo(frame) : std::nullopt;
    if (!recorder_) {
      open(c1Mo_seen ? c1Mo_seen : c1Mo);
    }
    if (last_index_ && frame.index > *last_index_ + 1) {
      report_.missed += frame.index - *last_index_ - 1;
    }
    last_index_ = frame.index;
    const Time time = frame.time;
    report_.without_truth += past_ && !c1Mo ? 1 : 0;
    if (recorder_->addFrame(std::move(frame), c1Mo)) {
      ++stored_;
      first_ = first_.value_or(time);
      last_ = time;
    } else {
      ++report_.left_out;
    }
  }

  void open(const std::optional<Pose>& c1Mo_start) {
    const bool edges = job_.follow == TrackerKind::kEdges;
    SequenceInfo info;
    info.name = job_.name.empty() ? cell_.name : job_.name;
    info.rate_hz = cell_.vision.rate_hz;
    info.target = edges ? cell_.hook.model : cell_.hook.plate;
    info.c1Mo_start = c1Mo_start;
    info.notes = notes();
    info.licence = job_.licence;
    info.image_format = job_.image_format;
    report_.target = info.target.filename().string();
    clearRecordingFolder(job_.out);
    recorder_ = std::make_unique<SequenceRecorder>(
        std::make_unique<SequenceWriter>(job_.out, info, devices_.told_rig), kFramesWaiting,
        devices_.world ? SequenceRecorder::WhenFull::kWait : SequenceRecorder::WhenFull::kLeaveOut);
    if (devices_.world) {
      truth_log_.emplace(job_.out / "truth", *devices_.world, devices_.true_rig);
    }
  }

  [[nodiscard]] std::string notes() const {
    std::string text = job_.notes;
    if (devices_.world) {
      text += (text.empty() ? "" : "; ") + std::string("simulated: scenario ") + devices_.scenario +
              ", seed " + std::to_string(job_.choice.seed) +
              "; truth.csv is c1Mo with the left camera where it truly stands";
    }
    return text;
  }

  void close() {
    if (recorder_) {
      recorder_->close();
      report_.frames = recorder_->framesStored();
    }
    if (truth_log_) {
      truth_log_->commit();
    }
    report_.duration_s = recordedSeconds();
  }

  const RecordJob& job_;
  const RecordProgress& progress_;
  CellConfig cell_;
  CellDevices devices_;
  std::optional<VisionStep> vision_;
  std::optional<HookPast> past_;
  std::optional<TruthLog> truth_log_;
  std::unique_ptr<SequenceRecorder> recorder_;
  std::array<Window, 2> windows_;
  std::size_t stored_ = 0;
  std::optional<Time> begin_;
  std::optional<Time> first_;
  std::optional<Time> last_;
  std::optional<Time> last_state_;
  std::optional<std::uint64_t> last_index_;
  RecordReport report_;
};

}  // namespace

RecordReport runRecord(const RecordJob& job, const std::atomic<bool>& stop,
                       const RecordProgress& progress) {
  checkRecordingFolder(job.out, job.overwrite);
  Recording recording(job, progress);
  try {
    return recording.run(stop);
  } catch (const Error& e) {
    const std::size_t kept = recording.keep();
    if (kept == 0) {
      throw;
    }
    std::string sentence = e.what();
    if (sentence.ends_with('.')) {
      sentence.pop_back();
    }
    throw Error(sentence + "; " + std::to_string(kept) + " whole frames are kept in " +
                job.out.string());
  }
}

}  // namespace ringhook
