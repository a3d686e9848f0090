#pragma once

/// \file
/// The task as a state machine on the arm's clock: one arm state and the newest hook estimate in,
/// one velocity command out, for one hook after the other.
///
///   Load -> Grip -> Standby -> Wait -> Approach -> Align -> Lower -> Release -> Retreat -> Watch
///                                \_________________________/
///                                   abort: BackOff -> Done, the ring stays in the gripper
///
/// What aborts an attempt is named: estimate stale or lost, alignment not reached in time, ring off
/// its path while lowering, hook out of the arm's window, no hook. A stale estimate and a ring off
/// its path say nothing against the hook: once the ring is away from it and the estimate fresh, the
/// same hook is tried once more (BackOff -> Wait), if it can still be served in the arm's window.
/// Reads no clock and no device.

#include <optional>
#include <string>

#include "cycle/arm_motion.h"
#include "cycle/cell_config.h"
#include "cycle/statistics.h"
#include "servo/insertion_path.h"

namespace ringhook {

enum class TaskPhase {
  kLoad,      ///< to where a ring is put into the gripper
  kGrip,      ///< the gripper closes
  kStandby,   ///< to where hooks are met
  kWait,      ///< for a hook that may be acted upon
  kApproach,  ///< to beside the hook
  kAlign,     ///< over the tip, until the ring follows it closely
  kLower,     ///< over the tip
  kRelease,   ///< the gripper opens
  kRetreat,   ///< the gripper leaves
  kWatch,     ///< the ring is left to hang
  kBackOff,   ///< after an abort: up and away from the hook
  kDone
};

/// Short name, as in tables and records: "load", "grip" ...
const char* phaseName(TaskPhase phase);

/// One answer to one state of the arm.
struct TaskCommand {
  JointVector velocity = JointVector::Zero();  ///< [rad/s]
  std::optional<bool> close_gripper;           ///< to be sent now
  TaskPhase phase = TaskPhase::kDone;          ///< that this command belongs to
  std::optional<double> error_m;               ///< ring against goal, while following
  bool limited = false;                        ///< a limit bent the command
};

/// What became of one hook.
struct AttemptResult {
  bool released = false;            ///< the ring was let go over the tip
  int tries = 0;                    ///< approaches to the hook
  std::string abort_reason;         ///< why not; empty if released
  Time started;                     ///< first state of the attempt
  std::optional<Time> met;          ///< approach began
  std::optional<Time> released_at;  ///< gripper was told to open
  Time ended;
  Statistics tracking_error_m;  ///< ring against goal from lowering to release
};

class TaskControl {
 public:
  /// \param arm as calibrated.
  TaskControl(const CellConfig& cell, const rx60::Geometry& arm);

  /// Begins with the next hook; a ring still held is kept.
  void startAttempt();

  /// `hook`: newest estimate, nothing while none is tracked.
  TaskCommand step(const ArmState& state, const std::optional<HookFilterState>& hook);

  [[nodiscard]] bool finished() const { return phase_ == TaskPhase::kDone; }
  [[nodiscard]] TaskPhase phase() const { return phase_; }
  [[nodiscard]] const AttemptResult& result() const { return result_; }
  /// True from the moment when this hook needs no more watching.
  [[nodiscard]] bool hookDone() const;

 private:
  TaskCommand coarse(const ArmState& state, const JointVector& target, TaskPhase next);
  TaskCommand grip(const ArmState& state);
  TaskCommand wait(const ArmState& state);
  void meet(const HookEstimate& hook, const ArmState& state);
  TaskCommand follow(const ArmState& state);
  TaskCommand backOff(const ArmState& state);
  TaskCommand resting(const ArmState& state);

  void enter(TaskPhase phase, const ArmState& state);
  void enterPath(TaskPhase phase, InsertionPhase path, const Pose& oMr, const ArmState& state);
  void advance(const ArmState& state, double error_m);
  void advanceFromAlign(const ArmState& state, double error_m);
  void abort(const std::string& reason, const ArmState& state);
  [[nodiscard]] std::string whyNotFollow(const ArmState& state) const;
  [[nodiscard]] bool stale(const ArmState& state) const;
  [[nodiscard]] std::optional<Pose> hookNow(const ArmState& state) const;

  CellConfig cell_;
  InsertionParameters path_parameters_;
  ArmMotion motion_;
  TaskPhase phase_ = TaskPhase::kDone;
  bool ring_held_ = false;
  bool fresh_ = false;  ///< startAttempt() was called, no state seen yet
  Time phase_start_;
  RingPath path_;  ///< of the phases that follow the hook
  std::optional<Time> aligned_since_;
  std::optional<HookFilterState> hook_;  ///< newest estimate, kept when the hook is lost
  bool hook_seen_ = false;               ///< vision has an estimate now
  bool may_try_again_ = false;           ///< what aborted says nothing against the hook
  std::optional<bool> gripper_order_;    ///< to go out with the next command
  AttemptResult result_;
};

}  // namespace ringhook
