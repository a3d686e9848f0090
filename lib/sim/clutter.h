#pragma once

/// \file
/// What else stands and hangs about in the hall, between the belt and the wall and never in front
/// of the hooks: boxes, pipes, cables, and hooks on another belt that look like those the cell
/// serves but carry no plate. Only to be looked at.

#include <cstdint>
#include <string>

#include "sim/scene_options.h"

namespace ringhook {

/// options.clutter things in f, of kinds that take turns; MJCF of geoms in a body at f.
std::string clutterXml(const SceneOptions& options, std::uint64_t cell_seed);

}  // namespace ringhook
