#pragma once

/// \file
/// The wall behind the arm as a picture, periodic at its borders. Plain: stains of a few per cent.
/// Textured: panels of different tone with dark joints, notices with edges as strong as the hook's,
/// streaks and stains.

#include "core/image.h"
#include "sim/scene_options.h"

namespace ringhook {

/// Texels along each side of the picture.
int wallTexels(WallKind kind);

/// Grey values; 205 is the wall's mean tone.
GrayImage wallPicture(const SceneOptions& options, std::uint64_t cell_seed);

}  // namespace ringhook
