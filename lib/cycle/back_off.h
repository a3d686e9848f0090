#pragma once

/// \file
/// The way out of an attempt that is given up: first straight up relative to the hook, until the
/// ring is clear of the tip, then away from it towards the arm. Legs from rest to rest at half of
/// the mean speed that lowering and approaching would have.

#include "servo/insertion_path.h"

namespace ringhook {

/// \param oMr_start where the ring is now, in the hook frame. A ring that is above the hover point
/// already only leaves.
RingPath planBackOff(const Pose& oMr_start, const InsertionParameters& parameters);

}  // namespace ringhook
