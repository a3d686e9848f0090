#pragma once

/// \file
/// The cell's own hook as a pendulum: one hook on a standing belt, for a minute, with a choice of
/// what brakes it.

#include <vector>

#include "sim/cell_options.h"
#include "sim/pendulum_world.h"

namespace ringhook {

/// A cell with one hook on a standing belt, swinging from the start with these amplitudes [rad]; no
/// air, no friction, no randomness but the phases of the swings.
CellOptions hangingHookCell(double swing_about_x, double swing_about_y);

struct HangingHookRun {
  std::vector<PendulumSample> about_x;  ///< swing about x_f, after every physics step
  std::vector<double> energy;           ///< mechanical, above hanging still, at those instants [J]
};

/// Runs the cell's first hook for `duration_s` [s].
HangingHookRun runHangingHook(const CellOptions& options, double duration_s);

/// Amplitude of the swing about x at its turning points, both sides [rad].
std::vector<double> turningPoints(const std::vector<PendulumSample>& samples);

}  // namespace ringhook
