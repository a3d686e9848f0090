#pragma once

/// \file
/// The motion by which delays are found: every joint swings a little about where it stands, each
/// with two frequencies of its own, so that the plate moves and turns in all directions and never
/// repeats itself within a run. Law: q = q0 + A e(t) (sin(2 pi f1 t) + sin(2 pi f2 t + phase)) / 2,
/// e rising from 0 to 1 and falling back within a second by a minimum-jerk quintic. Small enough to
/// stay where the arm is safe at rest (about 15 mm at the gripper), fast enough that a millisecond
/// shows (about 60 px/s in the default cell).

#include "core/joints.h"
#include "servo/joint_move.h"

namespace ringhook {

struct WiggleOptions {
  double seconds = 8.0;          ///< of the motion, rise and fall included, at least 3
  double amplitude_rad = 0.020;  ///< of joints 1 to 3; the wrist's are two and a half times that
};

class Wiggle {
 public:
  /// Throws InputError for options out of range.
  Wiggle(const JointVector& middle, const WiggleOptions& options);

  /// Joints and their velocities `t` seconds after the begin; at rest before and after.
  [[nodiscard]] JointSample at(double t) const;
  [[nodiscard]] double seconds() const { return options_.seconds; }

 private:
  JointVector middle_;
  WiggleOptions options_;
};

}  // namespace ringhook
