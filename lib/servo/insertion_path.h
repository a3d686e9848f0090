#pragma once

/// \file
/// The ring's path relative to the hook, phase by phase, in the hook frame o of doc/frames.md:
///
///   Approach  from wherever the ring is to the standoff: level with the hover point, but beside
///             the hook on the arm's side (-x_o), never through the hook
///   Align     sideways along x_o to the hover point, straight above the tip
///   Lower     straight down over the tip to the place of release
///   Hold      standing still there while the gripper opens
///   Retreat   the gripper leaves along -x_o, the ring stays on the hook
///
/// Each phase is a chain of straight legs from rest to rest, scaled in time by the minimum-jerk
/// quintic s = 10 u^3 - 15 u^4 + 6 u^5, u = t / T (Flash and Hogan, J. Neurosci. 1985): peak speed
/// 15/8 D/T, peak acceleration 10/sqrt(3) D/T^2. Orientation turns about one axis at the same pace.

#include <vector>

#include "core/pose.h"
#include "servo/ring_goal.h"

namespace ringhook {

enum class InsertionPhase { kApproach, kAlign, kLower, kHold, kRetreat };

/// Short name, as in tables and records: "approach", "align", "lower", "hold", "retreat".
const char* phaseName(InsertionPhase phase);

/// Fastest motion relative to the hook; all values positive.
struct PathSpeed {
  double linear;                ///< peak speed [m/s]
  double angular;               ///< peak turning rate [rad/s]
  double acceleration;          ///< peak acceleration [m/s^2]
  double angular_acceleration;  ///< peak [rad/s^2]
};

/// Places on the default hook and speeds. The ring is parallel to o from the standoff on.
struct InsertionParameters {
  Eigen::Vector3d tip_o{0.0, 0.035, 0.025};            ///< top of the tip's centreline [m]
  double hover_height = 0.05;                          ///< hover point above tip_o along z_o [m]
  Eigen::Vector3d standoff_offset_o{-0.10, 0.0, 0.0};  ///< standoff from the hover point [m]
  Eigen::Vector3d release_o{0.0, 0.035, 0.007};        ///< ring centre at release [m]
  Eigen::Vector3d retreat_o{-0.10, 0.0, 0.0};          ///< motion of the gripper after release [m]
  /// Half width, along x_o, of the slab about the hook's plane that the ring may enter only above
  /// the tip: ring radius, gripper and swing error [m].
  double clearance = 0.06;
  double hold_s = 0.25;  ///< for the gripper to open [s]
  PathSpeed approach{0.30, 1.5, 2.0, 10.0};
  PathSpeed align{0.15, 1.0, 1.0, 5.0};
  PathSpeed lower{0.08, 0.5, 0.5, 5.0};
  PathSpeed retreat{0.25, 1.0, 1.5, 5.0};
};

/// One straight motion from rest to rest.
struct PathLeg {
  Pose oMr_start = Pose::Identity();
  Pose oMr_end = Pose::Identity();
  double duration_s = 0.0;
};

/// Legs done one after the other.
using RingPath = std::vector<PathLeg>;

/// Path of one phase for a ring that is at oMr_start now. Approach makes up to four legs: a ring
/// behind the hook (x > clearance) goes round it on the tip's side first, a ring beside its plane
/// first leaves along -x_o; it is turned parallel to o only on the last leg, beside the hook.
/// Hold stays at oMr_start; Retreat is relative to oMr_start. Throws InputError for parameters
/// that are not positive and finite.
RingPath planPhase(InsertionPhase phase, const Pose& oMr_start, const InsertionParameters& p);

/// Sum of the legs [s].
double pathDuration(const RingPath& path);

/// Goal `s` seconds after the path's start; before it the start, after it the end, at rest.
/// Precondition: the path has a leg.
RingGoal samplePath(const RingPath& path, double s);

}  // namespace ringhook
