#pragma once

/// \file
/// The cell's settings in the terms of the path over a hook, and what such a path takes in time.

#include "cycle/cell_config.h"
#include "servo/insertion_path.h"

namespace ringhook {

InsertionParameters pathParameters(const CellConfig& cell);

/// Time from standby until the ring is let go [s], from above: decides whether a hook that is met
/// now can be served before it leaves the arm's window.
double insertionTime(const CellConfig& cell, const InsertionParameters& parameters);

}  // namespace ringhook
