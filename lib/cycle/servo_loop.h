#pragma once

/// \file
/// One attempt on one hook, clocked by the arm: wait for its state, ask vision for its newest
/// estimate, answer with one velocity. The same code runs on simulated devices in virtual time and
/// on real ones (vision_side.h); it reads no clock.
/// The arm comes first: whatever is thrown in here, by a device, a stage or an observer, and also
/// the operator's wish to stop, stops the arm before anything else happens, then goes on upwards.

#include <atomic>

#include "cycle/task_control.h"
#include "cycle/vision_side.h"
#include "robot/arm.h"

namespace ringhook {

/// Watches an attempt: records, counts, draws. It cannot change anything.
class LoopObserver {
 public:
  LoopObserver() = default;
  LoopObserver(const LoopObserver&) = delete;
  LoopObserver& operator=(const LoopObserver&) = delete;
  virtual ~LoopObserver() = default;

  /// After a frame was processed. `age_s`: from mid-exposure to the arm state being answered [s].
  /// In real time this is called on vision's thread.
  virtual void onFrame(const StereoFrame& frame, const VisionReport& report, double age_s) = 0;
  /// After a command was sent.
  virtual void onCommand(const ArmState& state, const TaskCommand& command) = 0;
};

/// Runs one attempt to its end. Throws Interrupted once `stop` is set, after stopping the arm;
/// rethrows whatever a device or stage threw, after stopping the arm.
AttemptResult runAttempt(VisionSide& vision, Arm& arm, TaskControl& task, LoopObserver& observer,
                         const std::atomic<bool>& stop);

}  // namespace ringhook
