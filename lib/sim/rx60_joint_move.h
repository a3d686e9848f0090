#pragma once

/// \file
/// The controller's own point-to-point move in joint space (movej): all joints start and end
/// together, the slowest sets the pace, and the common path parameter s from 0 to 1 has a
/// trapezoidal speed (Biagiotti and Melchiorri, "Trajectory Planning for Automatic Machines and
/// Robots", 2008, section 3.2). The controller would blend one move into the next; here each stops
/// at its point, which a client may not rely on either way.

#include "core/joints.h"

namespace ringhook {

class Rx60JointMove {
 public:
  /// \param start,goal [rad]. \param share of the joints' nominal speeds, above 0, at most 1;
  /// accelerations are those of `limits` in full.
  Rx60JointMove(const JointVector& start, const JointVector& goal, double share,
                const JointLimits& limits);

  [[nodiscard]] double duration() const { return duration_; }  ///< [s]
  /// Where the joints shall be `time_s` [s] after the start [rad].
  [[nodiscard]] JointVector position(double time_s) const;

 private:
  JointVector start_;        ///< [rad]
  JointVector goal_;         ///< [rad]
  double duration_ = 0.0;    ///< [s]
  double ramp_ = 0.0;        ///< duration of speeding up, and of slowing down [s]
  double peak_speed_ = 0.0;  ///< of s [1/s]
};

}  // namespace ringhook
