#pragma once

/// \file
/// The prescribed motions of arm and belt. Each step asks for the joint acceleration that puts the
/// joint exactly on its set point one step later (semi-implicit Euler: q' = q + h (v + h a)), and
/// applies the generalised forces tau = M a + bias - passive that cause it.

namespace ringhook {

struct CellState;

/// Moves the set points of arm and belt on by one physics step and applies the forces for it.
void driveMotions(CellState& cell);

}  // namespace ringhook
