#pragma once

/// \file
/// The printed face of a tag plate as a picture, made from the codes of Debian's libapriltag, so
/// that what is rendered is what the detector knows. Family tag36h11: 6x6 data modules inside a
/// black border one module wide inside a white border one module wide (Wang and Olson,
/// "AprilTag 2: Efficient and robust fiducial detection", IROS 2016).

#include <vector>

#include "core/image.h"

namespace ringhook {

/// 10 x 10 modules of a tag36h11 tag, white border included, as one reads it: 255 white, 0 black.
/// Throws InputError for an id outside the family.
GrayImage tagModules(int id);

/// A plate with one column of tags on white ground, the first id uppermost.
struct TagPlateFace {
  double width = 0.054;         ///< of the plate [m]
  double height = 0.108;        ///< of the plate [m]
  double tag_size = 0.040;      ///< side of the black square [m]
  double tag_distance = 0.054;  ///< between the centres of neighbouring tags [m]
  std::vector<int> ids;         ///< uppermost first
};

/// Picture of the face with square texels of `texel` [m]. The borders between black and white lie
/// exactly between texels if the face's measures are whole multiples of it.
GrayImage drawTagPlate(const TagPlateFace& face, double texel);

}  // namespace ringhook
