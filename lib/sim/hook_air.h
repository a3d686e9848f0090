#pragma once

/// \file
/// Air drag of the swinging hook. MuJoCo 2.2 has two models of a medium. The default one replaces a
/// body by the box that has its inertia, which for a J with a plate says little about the faces
/// that meet the air: 3 times too little drag along the belt. The other one takes ellipsoids, one a
/// geom:
///     F = -rho |v| v (b A + s (A_max - A)),   A the ellipse that the ellipsoid shows to the flow,
/// plus a slight viscous term. With b = 2 C / pi and s = 0 that is F = rho/2 C A_box |v| v for a
/// box with the same half axes in flow along one of them: the drag equation, quadratic in v. Here
/// the bars are cut into short pieces, each with its own speed (strip theory), C = 2 for a bar
/// across the flow and 1.2 for the plate (Hoerner, "Fluid-Dynamic Drag", 1965, chapter 3). Lift,
/// Magnus and angular drag of the pieces are left out. The pieces weigh nothing and touch nothing.

#include <string>
#include <vector>

#include "sim/hook_body.h"

namespace ringhook {

/// A box of the hook as the air meets it.
struct AirPiece {
  HookPart box;                   ///< its mass is not used
  double drag_coefficient = 2.0;  ///< C of the drag equation
};

/// Shank above and below the plate, plate with what it hides, arc, tip.
std::vector<AirPiece> hookAirPieces(const HookShape& shape = {});

/// The pieces as geoms of the hook's body (MJCF).
std::string hookAirXml();

}  // namespace ringhook
