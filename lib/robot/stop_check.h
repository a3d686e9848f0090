#pragma once

/// \file
/// Does the arm, going at some rate now, keep every limit until it stands still?
///
/// Law: fail-safe planning. A motion is begun only together with a verified plan that ends at rest;
/// as the plan of one period ago can always be carried on, limits are kept for ever (Petti and
/// Fraichard, "Safe motion planning in dynamic environments", IROS 2005; Wabersich and Zeilinger,
/// "A predictive safety filter for learning-based control of constrained nonlinear dynamical
/// systems", Automatica 129, 2021; the safe terminal set here is standstill). The plan: every joint
/// brakes as fast as its acceleration and jerk allow (robot/jerk_step.h), rolled out period by
/// period. Speeds are looked at on both ends of each period, places at its end.

#include <array>

#include "robot/jerk_step.h"
#include "robot/rx60/tool_point.h"

namespace ringhook {

/// Axis-aligned box in f [m]; infinite sides bound nothing.
struct WorkspaceBox {
  Eigen::Vector3d lower;
  Eigen::Vector3d upper;
};

/// What holds in one period.
struct StopBounds {
  std::array<JointBounds, 6> joints;
  JointVector lower;        ///< least position [rad]
  JointVector upper;        ///< greatest [rad]
  double tool_speed = 0.0;  ///< [m/s]
  WorkspaceBox box;         ///< for the tool point
  rx60::Geometry geometry;
  Eigen::Vector3d tool_e;       ///< tool point on the flange [m]
  double singular_below = 0.0;  ///< manipulability where the permitted speeds shrink [m^3]
  double least_share = 1.0;     ///< of the speeds that is left at the singularity itself

  /// Share of the joint speeds permitted at this manipulability.
  [[nodiscard]] double share(double manipulability) const;
  /// Greatest ratio of a joint's speed [rad/s] to its bound.
  [[nodiscard]] double speedRatio(const JointVector& velocity) const;
};

enum class BrokenLimit { kNone, kPosition, kToolSpeed, kSingular, kWorkspace };

/// Where the joints may be [rad]: the estimate, and a range that surely holds them.
struct JointPlace {
  JointVector estimate;
  JointVector low;
  JointVector high;
};

using JointRates = std::array<JointRate, 6>;

/// The first limit that breaks when the arm at `place` goes at `rates` for one period and brakes
/// from then on.
BrokenLimit firstBroken(const StopBounds& bounds, const JointPlace& place, JointRates rates);

}  // namespace ringhook
