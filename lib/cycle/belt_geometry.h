#pragma once

/// \file
/// Hooks on the belt as poses: where a hook would be that hangs, or swings, at a travel along the
/// belt; and whether a pose can be that of a hook on this belt at all. A travel is the distance of
/// the pivot along the belt's direction from the belt's start point [m].

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/hook_values.h"
#include "core/pose.h"
#include "cycle/cell_config.h"

namespace ringhook {

/// fMo of a hook with its pivot at `travel_m`, swung by the two angles [rad] (hanging_pose.h).
Pose hookOnBelt(const CellConfig& cell, double travel_m, double swing_x_rad, double swing_y_rad);

/// Travel of the pivot of a hook at fMo [m].
double hookTravel(const CellConfig& cell, const Pose& fMo);

/// Speed of the hook's pivot along the belt [m/s]; the swing has no part in it.
double hookTravelSpeed(const CellConfig& cell, const HookEstimate& hook);

/// Empty if fMo may be a hook on this belt; else what speaks against it: pivot farther than
/// `tolerance_m` from the belt's line, swing beyond 1.5 times the largest expected, hook turned.
std::string whyNotOnBelt(const CellConfig& cell, const Pose& fMo, double tolerance_m);

/// Whether the hook is where new ones are looked for, or `tolerance_m` before or behind: a camera
/// in real time still shows some frames of the last hook after the windows were told to leave it.
bool comesIn(const CellConfig& cell, const Pose& fMo, double tolerance_m);

/// Poses that together span where a new hook is looked for: both ends of the search range, each
/// hanging and swung fully to either side.
std::vector<Pose> searchPoses(const CellConfig& cell);

}  // namespace ringhook
