#pragma once

/// \file
/// One seeded cell: the values that CellOptions leaves to chance, drawn once. The draws are made
/// here from the generator's bits, so that a seed means the same cell with every standard library.
/// Drawn, in this order, each uniform unless said otherwise:
/// - from the seed's first stream: belt speed; the arm's six joint zero errors (normal); then for
///   each hook its pivot height, friction, damping, and per plane the phase of its swing;
/// - from its second stream: for each hook the amplitude per plane;
/// - from its third stream: phases of the belt's ripple, then how long it runs and stands.
/// A stream of its own keeps what was drawn before as it is when something is added. The scene's
/// draws (lamps, wall, clutter, occluders, noise) and the rig's errors are made where they are used
/// (scene_options.h, nominal_rig.h), from the same seed.

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
  double belt_speed = 0.0;  ///< of the drive when it runs [m/s]
  BeltProfile belt;
  JointVector zero_error = JointVector::Zero();  ///< true minus reported joints [rad]
  std::vector<HookDraw> hooks;
};

/// The cell that options.seed stands for.
CellDraw drawCell(const CellOptions& options);

}  // namespace ringhook
