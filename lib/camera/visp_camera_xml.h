#pragma once

/// \file
/// ViSP's camera files (vpXmlParserCamera) as rigs of one camera. ViSP's distortion
/// x_d = x_u (1 + kud r_u^2) is the first radial term of OpenCV's model, so k1 = kud exactly; the
/// inverse polynomial kdu is an approximation and not used.

#include <filesystem>

#include "rig/stereo_rig.h"

namespace ringhook {

/// Size of an image [px]; zero where unknown.
struct ImageSize {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
};

/// The camera called `name` (empty: the only or first one) in a ViSP file; a model with
/// distortion is preferred. `size` fills in for a file without image size. Throws InputError if
/// the file cannot be read, holds no such camera, or leaves the size open.
[[nodiscard]] StereoRig loadVispCamera(const std::filesystem::path& file, const std::string& name,
                                       ImageSize size);

/// Rig from rig.yaml, or from a ViSP camera file by the extension .xml. Throws InputError.
[[nodiscard]] StereoRig loadAnyRig(const std::filesystem::path& file, ImageSize size = {});

}  // namespace ringhook
