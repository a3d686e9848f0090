#pragma once

/// \file
/// Whether a coarse move is free of what stands about in every cell: floor, the arm's own pedestal,
/// the belt. Law: elbow, wrist, flange, the tool's end and the upper edge of its plate, followed in
/// small steps along the straight way in joint space, keep a distance from each. Hooks on the belt,
/// people and whatever else stands in a real cell are not known here.

#include <optional>
#include <string>

#include "core/joints.h"
#include "cycle/cell_config.h"

namespace ringhook {

/// What is in the way from `start` to `end` [rad], as a phrase; nothing if the way is free.
std::optional<std::string> inTheWay(const CellConfig& cell, const JointVector& start,
                                    const JointVector& end);

}  // namespace ringhook
