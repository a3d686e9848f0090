#pragma once

/// \file
/// Finds the hook in a pair of images without a click, a mark or a previous pose. A hook on the
/// belt has four unknowns only: how far along the belt its pivot is, two swing angles, and how much
/// longer than in its model it hangs (hooks and trolleys differ by millimetres, and an edge tracker
/// that starts a few of them too high locks on the wrong edges). Every cell of a grid over the
/// first three is scored on both images, the best ones are refined in all four, and the answer is
/// refused where it is weak or where another place looks as good. Law: the score is the mean over
/// model edge points of max(0, 1 - d/T), d being the distance to the nearest image edge of like
/// direction, T a cut-off (oriented chamfer matching; Shotton, Blake, Cipolla, "Multiscale
/// categorical object recognition using contour fragments", PAMI 2008).

#include <Eigen/Core>

#include "core/outcome.h"
#include "core/pose.h"
#include "core/stereo_frame.h"
#include "tracking/edge_model.h"

namespace ringhook {

/// Where a hook may be. Hanging at rest, o is parallel to f (doc/frames.md).
struct SearchSpace {
  Pose fMc1 = Pose::Identity();                                 ///< left camera in f
  Eigen::Vector3d pivot_start_f{0.42, 0.0, 1.05};               ///< pivot at travel 0 [m]
  Eigen::Vector3d belt_direction_f = Eigen::Vector3d::UnitY();  ///< of length 1
  double travel_from_m = -0.30;                                 ///< along the belt [m]
  double travel_to_m = 0.30;                                    ///< along the belt [m]
  Eigen::Vector3d pivot_o{0.0, 0.0, 0.45};                      ///< pivot in the hook model [m]
  double swing_x = 0.27;         ///< largest angle about x_f, in the plane of the belt [rad]
  double swing_y = 0.27;         ///< largest angle about y_f, across the belt [rad]
  double longer = 0.012;         ///< largest difference of the hanging length, either way [m]
  double travel_step_m = 0.008;  ///< of the coarse grid [m]
  double swing_step = 0.022;     ///< of the coarse grid, both angles [rad]
  double min_score = 0.60;       ///< weaker matches are no hook
  double min_lead = 0.05;        ///< least lead over the best match elsewhere
};

/// Hook pose in f for a place in the space: travel [m], angles about x_f and y_f [rad], and how
/// much longer than pivot_o it hangs [m].
Pose hookAt(const SearchSpace& space, double travel_m, double angle_x, double angle_y,
            double longer_m = 0.0);

/// Best place of the hook, c1Mo, within a few pixels. Refuses "no hook found" or "two places look
/// like the hook". Throws InputError for steps that are not positive or an empty range.
Outcome<Pose> findHook(const RectifiedFrame& frame, const EdgeModel& model,
                       const SearchSpace& space);

}  // namespace ringhook
