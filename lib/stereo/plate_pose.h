#pragma once

/// \file
/// Pose of a flat target from its corners, other ways than the joint refinement: for comparison
/// and for starting.
/// - platePoseFromPoints: the way of the 2007 report (Jeyabalan, Fork project): each corner seen
///   twice is triangulated at the midpoint, a plane is fitted to the points, and the pose follows
///   from its normal and a rigid fit within the plane.
/// - planarStartPose: homography by the normalised direct linear transform (Hartley and Zisserman,
///   section 4.4), decomposed for its pose, and the second pose that a flat target allows, with its
///   normal mirrored at the line of sight (Schweighofer and Pinz, PAMI 2006; Collins and Bartoli,
///   IJCV 2014). Every candidate of every camera is refined over all cameras given; the least
///   reprojection error decides.

#include <vector>

#include "core/hook_values.h"
#include "core/outcome.h"

namespace ringhook {

/// c1Mo from corners seen in both of two cameras (matched by point_o). Refuses "needs two cameras",
/// the reasons of triangulation and plane fit, and "corners not in one plane" (model farther from
/// a plane than 1/50 of its extent).
Outcome<Pose> platePoseFromPoints(const HookView& view);

/// c1Mo without any start, from one or two cameras with at least four corners each of one plane.
/// `cameras` that see fewer are used for the choice only. Refuses "too few corners", "corners not
/// in one plane", "corners seen on one line", "no pose explains the corners".
Outcome<Pose> planarStartPose(const std::vector<CameraFeatures>& cameras);

/// The hook from one camera of the view alone (index into view.cameras), as the report's single
/// view: planar start, then joint refinement with that camera only.
Outcome<HookFix> singleViewFix(const HookView& view, std::size_t camera);

}  // namespace ringhook
