#pragma once

/// \file
/// Which forces acted during the last physics step: contacts as MuJoCo solved them, their sums per
/// ring, and what the gripper's weld bore.

namespace ringhook {

struct CellState;

/// Notes contacts and grip of the step just solved; to be called before the next step's contacts
/// replace them.
void recordForces(CellState& cell);

}  // namespace ringhook
