#pragma once

/// \file
/// What the RX60 and its gripper look like: simple shapes with the true lengths (shoulder height
/// 341 mm, upper arm 290 mm, elbow offset 49 mm, forearm 310 mm, wrist to flange 65 mm), as MJCF
/// fragments for the bodies of cell_model. Nothing here touches anything or weighs anything.
///
/// The gripper carries a small tag plate (frame g), 44 x 88 mm with two 32 mm tags 44 mm apart,
/// behind and above the ring as the cameras see it: while placing it faces them beside the hook.

#include <string>

#include "core/pose.h"
#include "sim/tag_pattern.h"

namespace ringhook {

/// The pedestal, in f.
std::string baseVisualXml();
/// Link 1 to 6, in the link's own frame of cell_model's chain.
std::string linkVisualXml(int link);
/// Palm, bracket and tag plate, in the flange frame e. \param palm_length from the flange [m].
std::string gripperVisualXml(double palm_length);

/// The gripper's tag plate: its face, and its pose in the flange: x_g = y_e, y_g = x_e, z_g = -z_e.
TagPlateFace gripperPlateFace();
Pose eMg();
/// That plate in the layout of doc/formats.md: datasets/models/gripper/marker.yaml.
std::string gripperMarkerYaml();

}  // namespace ringhook
