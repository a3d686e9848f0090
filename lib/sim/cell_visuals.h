#pragma once

/// \file
/// How the cell looks: colours, lamps, the wall behind the arm, and the printed plates, as MJCF
/// fragments for cell_model. Two lamps without shadows; brightness and the wall's tone differ a
/// little from seed to seed. A printed pattern is a texture with square texels whose borders lie
/// between texels, so that sampling places them exactly; the texture is made blank by MJCF and
/// painted into the compiled model.

#include <cstdint>
#include <string>

struct mjModel_;

namespace ringhook {

/// Contents of <visual>.
std::string visualSettingsXml();
/// Contents of <asset>: materials steel, arm, gripper, ring, belt, plate, floor, and the textured
/// ones of wall and tag plate.
std::string visualAssetXml();
/// Lamps and wall, for <worldbody>.
std::string sceneVisualXml(std::uint64_t seed);
/// The hook's printed plate in o, to be put into the hook's body; it weighs nothing.
std::string tagPlateXml();

/// Paints plate and wall into the model's blank textures; before a renderer is made from it.
/// A model without them stays as it is.
void paintTextures(mjModel_& model, std::uint64_t seed);

}  // namespace ringhook
