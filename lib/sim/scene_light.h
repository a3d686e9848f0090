#pragma once

/// \file
/// The lamps that a LightSetup stands for, as the renderer uses them: one key lamp that casts
/// shadows, one fill lamp that does not, and the light of the surroundings. Far lamps: their light
/// comes from one direction. Each seed turns and dims the lamps a little.

#include <Eigen/Core>
#include <cstdint>

#include "sim/scene_options.h"

namespace ringhook {

struct SceneLight {
  Eigen::Vector3d towards_key;   ///< unit vector in f from the cell to the key lamp
  Eigen::Vector3d towards_fill;  ///< likewise
  double key = 0.0;       ///< brightness of a white surface that faces the lamp; 1 fills the well
  double fill = 0.0;      ///< likewise
  double sky = 0.0;       ///< surroundings, on a white surface that faces up
  double ground = 0.0;    ///< surroundings, on a white surface that faces down
  double tubes = 0.0;     ///< brightness of the lamp rows that polished steel mirrors
  int shadow_map_px = 0;  ///< side of the shadow map [px]; 0: no shadows
};

/// \param cell_seed used where options.seed is 0.
SceneLight sceneLight(const SceneOptions& options, std::uint64_t cell_seed);

}  // namespace ringhook
