#pragma once

/// \file
/// Which part of the shadow map a picture looks up, and which solids throw shadows into it. A
/// window of the image shows a few solids, and of each only what lies in the window's pyramid;
/// where these meet the box that the map covers, and nowhere else, the map has to be drawn. The
/// lamp's light is parallel, so the map's coordinates are linear in f. Everything here errs on the
/// large side: pixels do not depend on it.

#include <Eigen/Core>
#include <vector>

#include "core/image.h"
#include "sim/solids.h"

namespace ringhook {

/// A rectangle of an image plane that will be drawn.
struct SeenPart {
  Pinhole eye;
  Window part;  ///< [px]
};

/// The map: `side` x `side` texels over a box.
struct ShadowBox {
  Eigen::Matrix4d clip = Eigen::Matrix4d::Identity();  ///< from f to the box, -1 to 1 (affine)
  int side = 0;
};

/// Texels that the solids look up in these parts, with a margin for interpolation.
Window shadowTexels(const ShadowBox& box, const std::vector<Solid>& solids,
                    const std::vector<SeenPart>& seen);

/// Whether the solid covers any of these texels.
bool throwsInto(const Solid& solid, const ShadowBox& box, const Window& texels);

}  // namespace ringhook
