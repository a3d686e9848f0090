#pragma once

/// \file
/// Watches the servo task in the simulated cell and knows the truth: whether the ring hangs two
/// seconds after it was let go, how hard it touched before, how far the loop's belief was off. It
/// also records one cycle as a sequence with truth. The loop never learns any of it.

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "camera/sequence_writer.h"
#include "cycle/loop_statistics.h"
#include "cycle/servo_loop.h"
#include "sim/cell_world.h"
#include "sim/truth.h"

namespace ringhook {

/// What physics says of one attempt.
struct AttemptTruth {
  int ring = -1;                ///< index of the ring in the gripper, kept when it is let go; or -1
  bool hanging = false;         ///< it hung on a hook two seconds later
  double peak_contact_n = 0.0;  ///< between hook and ring while gripped, greatest [N]
  Statistics insertion_error_m;  ///< true ring against true goal line of the tip, lowering [m]
};

class ServoWitness : public LoopObserver {
 public:
  /// `fMc1`: true left camera; `arm`: as told to the loop, for records. `on_judged` is called at
  /// the moment of judgement, for a picture.
  ServoWitness(const CellWorld& world, const Pose& fMc1, const rx60::Geometry& arm,
               const Eigen::Vector3d& release_o,
               std::function<void(const AttemptTruth&)> on_judged);

  /// Opens a recording whose first frame shows the hook at `c1Mo`.
  using OpenRecording = std::function<std::unique_ptr<SequenceWriter>(const Pose& c1Mo)>;

  /// Begins an attempt. With `open_recording` its frames are stored from the moment when
  /// the hook's estimate is fit to act upon until the hook is lost.
  void startAttempt(OpenRecording open_recording);
  /// Closes the recording, if there is one. Throws Error if it cannot be written.
  void endAttempt();
  [[nodiscard]] const AttemptTruth& attempt() const { return attempt_; }
  [[nodiscard]] const LoopStatistics& statistics() const { return statistics_; }

  void onFrame(const StereoFrame& frame, const VisionReport& report, double age_s) override;
  void onCommand(const ArmState& state, const TaskCommand& command) override;

 private:
  struct HookInstant {
    Time time;
    std::vector<Pose> fMo;  ///< of each hook
  };

  void recordFrame(const StereoFrame& frame, const std::optional<Pose>& fMo);
  [[nodiscard]] std::optional<Pose> trueHook(Time time, const Pose& near_fMo) const;
  void judge(Time now, const CellTruth& cell);

  const CellWorld& world_;
  Pose fMc1_;
  rx60::Geometry arm_;
  Eigen::Vector3d release_o_;
  std::function<void(const AttemptTruth&)> on_judged_;
  OpenRecording open_recording_;
  std::unique_ptr<SequenceWriter> recording_;
  AttemptTruth attempt_;
  LoopStatistics statistics_;
  std::deque<HookInstant> past_;      ///< of the last tenths of a second
  Pose seen_fMo_ = Pose::Identity();  ///< of the last fix
  std::optional<Time> released_at_;
  bool judged_ = false;
  JointLimits limits_;
};

}  // namespace ringhook
