#pragma once

/// \file
/// One seeded cell: the values that CellOptions leaves to chance, drawn once. The draws are made
/// here from the generator's bits, so that a seed means the same cell with every standard library.

#include <vector>

#include "core/joints.h"
#include "sim/cell_options.h"

namespace ringhook {

/// One hook as drawn.
struct HookDraw {
  double pivot_height = 0.45;  ///< above o [m]
  double friction = 0.0;       ///< Coulomb, each hinge [N m]
  double damping = 0.0;        ///< viscous, each hinge [N m s/rad]
  double angle[2] = {0, 0};    ///< swing about x_f, y_f at the entry [rad]
  double rate[2] = {0, 0};     ///< of those angles at the entry [rad/s]
};

struct CellDraw {
  double belt_speed = 0.0;                       ///< actual mean [m/s]
  JointVector zero_error = JointVector::Zero();  ///< true minus reported joints [rad]
  std::vector<HookDraw> hooks;
};

/// The cell that options.seed stands for.
CellDraw drawCell(const CellOptions& options);

/// Belt speed [m/s] at `time_s` [s].
double beltSpeed(const CellOptions& options, const CellDraw& draw, double time_s);

}  // namespace ringhook
