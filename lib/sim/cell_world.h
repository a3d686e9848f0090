#pragma once

/// \file
/// The default cell as one simulated world in virtual time: arm, gripper and feeder, belt, hooks,
/// rings, and nothing that reads a clock. Deterministic: the same options give the same world, bit
/// for bit. Time moves only in advanceTo(), in physics steps (0.5 ms by default).
///
/// Arm and belt are prescribed motions: drives of their kind are stiff and geared, so the joint
/// torques that put every joint on its set point at the end of each step are computed from the
/// inverse dynamics (Craig, "Introduction to Robotics", 3rd ed., section 10.3, computed torque with
/// dead-beat gains) and applied; contact and grip act back on them and are corrected in the next
/// step. The set point integrates the commanded joint velocity.
///
/// What a stage may know of this world it gets through the Arm and StereoCamera interfaces; the
/// world's true state leaves through sim/truth.h, which the loop cannot include.

#include <functional>
#include <memory>
#include <optional>

#include "core/joints.h"
#include "core/pose.h"
#include "core/time.h"
#include "sim/cell_options.h"

namespace ringhook {

struct MujocoHandles;
struct CellState;

class CellWorld {
 public:
  /// Throws Error if the options make no valid cell (naming the option).
  explicit CellWorld(const CellOptions& options);
  ~CellWorld();
  CellWorld(const CellWorld&) = delete;
  CellWorld& operator=(const CellWorld&) = delete;

  [[nodiscard]] const CellOptions& options() const;
  [[nodiscard]] Time time() const;

  /// Steps until `time` (rounded up to a whole physics step); does nothing if that is past. Throws
  /// Error if the simulation diverges, and whatever a callback throws.
  void advanceTo(Time time);

  /// Calls `action` with the current time at phase, phase + period, ... [s], each rounded to the
  /// nearest physics step, with all positions up to date; at one instant in order of registration.
  /// An instant that is already past is skipped. Returns an id for setPeriod.
  int every(double period_s, double phase_s, std::function<void(Time)> action);
  /// From the last call on the next ones follow `period_s` [s] apart. Throws Error if not positive.
  void setPeriod(int id, double period_s);

  /// Joint velocities [rad/s] until now + duration_s [s], then standstill. A joint stops at its
  /// limit. Precondition: finite.
  void setJointVelocity(const JointVector& joint_velocity, double duration_s);
  /// Encoder reading: joints [rad] of the nominal model, at this instant.
  [[nodiscard]] JointVector jointReading() const;

  /// Opens or closes the gripper. Closing an empty one away from the hooks takes a ring from the
  /// feeder (the operator's or a feeder's part); with the magazine empty it closes on nothing.
  void setGripper(bool closed);
  [[nodiscard]] bool gripperClosed() const;

  /// Holds the calibration board at fMt from now on, as an integrator's hand would; it touches
  /// nothing. Nothing: takes it away, out of sight and light. Throws Error if the cell has no board
  /// (SceneOptions::board) or the pose is not finite.
  void holdBoard(const std::optional<Pose>& fMt);

 private:
  friend MujocoHandles mujocoHandles(const CellWorld& world);
  friend const CellState& cellState(const CellWorld& world);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ringhook
