#pragma once

/// \file
/// What makes a hook a pendulum: two hinges through its pivot, x first, then y, each with dry and
/// viscous friction, and the hook's mass. As MJCF inside the hook's body, whose frame is o.

#include <string>

#include "sim/cell_draw.h"

namespace ringhook {

/// Joints `hookN_x`, `hookN_y` and the inertial element.
std::string hookHingesXml(const HookDraw& draw, int index);

}  // namespace ringhook
