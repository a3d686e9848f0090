#pragma once

/// \file
/// A cell in which nothing happens until a test asks for it.

#include "sim/cell_options.h"

namespace ringhook {

/// One hook at rest on a standing belt; no losses, no randomness.
inline CellOptions quietCell() {
  CellOptions options;
  options.air_density = options.air_viscosity = 0.0;
  options.hook.count = 1;
  options.hook.swing_about_x = options.hook.swing_about_y = 0.0;
  options.hook.pivot_friction = options.hook.pivot_damping = 0.0;
  options.hook.length_spread = 0.0;
  options.belt.speed = options.belt.start_y = options.belt.entry_y = 0.0;
  options.arm.zero_error_sigma = 0.0;
  options.ring.count = 1;
  return options;
}

}  // namespace ringhook
