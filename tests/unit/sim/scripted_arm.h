#pragma once

/// \file
/// Moves the simulated arm with full knowledge of the cell, for tests of the cell itself: the ring
/// follows a path given relative to a hook's true pose. No stage of the loop does this.

#include <functional>

#include "core/joints.h"
#include "core/pose.h"
#include "sim/cell_world.h"
#include "sim/sim_arm.h"

namespace ringhook {

/// Joints that hold the ring at fMr by nominal kinematics, near `reference` [rad].
JointVector jointsForRing(const CellOptions& options, const Pose& fMr,
                          const JointVector& reference);

/// Pose of the ring by nominal kinematics.
Pose ringFromJoints(const CellOptions& options, const JointVector& q);

/// A cell with a standing belt, one hook at rest at y = 0, and a gripper with a ring at `oMr`.
CellOptions standingCell(const Pose& oMr);

/// A pose with the axes of f.
Pose shifted(double x, double y, double z);

class ScriptedArm {
 public:
  ScriptedArm(CellWorld& world, std::size_t hook) : world_(world), arm_(world), hook_(hook) {}

  /// Moves the ring smoothly to oMr in `duration` [s] while the hook moves on. `watch` is called
  /// every 4 ms.
  void moveTo(const Pose& oMr, double duration, const std::function<void()>& watch = {});
  /// Stands still in f for `duration` [s].
  void rest(double duration, const std::function<void()>& watch = {});

  SimArm& arm() { return arm_; }

 private:
  CellWorld& world_;
  SimArm arm_;
  std::size_t hook_;
};

/// Path over the tip, release, retreat: the whole insertion on the hook that comes next.
void insertRing(ScriptedArm& arm, const std::function<void()>& watch);

}  // namespace ringhook
