#pragma once

/// \file
/// How the cell looks: colours, the wall behind the arm, clutter, printed plates and board, and the
/// bodies of passing occluders, as MJCF fragments for cell_model. Nothing here touches anything or
/// weighs anything. Textures are made blank by MJCF and painted into the compiled model; those
/// whose name starts with "print" are printed patterns with square texels whose borders lie
/// exactly between texels (shaders.h says how they are sampled).

#include <cstdint>
#include <string>

#include "sim/scene_options.h"

struct mjModel_;

namespace ringhook {

/// Contents of <visual>.
std::string visualSettingsXml();
/// Contents of <asset>: materials steel, arm, arm_dark, gripper, ring, belt, floor, metal, paint
/// and the textured ones of wall, plates and board.
std::string visualAssetXml(const SceneOptions& options);
/// Wall, clutter, board and occluders, for <worldbody>. \param cell_seed used where options.seed
/// is 0.
std::string sceneVisualXml(const SceneOptions& options, std::uint64_t cell_seed);
/// The hook's printed plate in o, to be put into the hook's body.
std::string tagPlateXml();

/// Paints plates, board and wall into the model's blank textures; before a renderer is made from
/// it. A model without them stays as it is.
void paintTextures(mjModel_& model, const SceneOptions& options, std::uint64_t cell_seed);

}  // namespace ringhook
