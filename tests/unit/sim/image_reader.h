#pragma once

/// \file
/// Independent readers of what the simulation draws: libapriltag's detector, and edges by area.

#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/image.h"

namespace ringhook {

/// Corners [px, first pixel's centre at (0, 0)] by tag id, in the tag's own order as one reads it:
/// upper left, upper right, lower right, lower left.
std::map<int, std::vector<Eigen::Vector2d>> readTags(GrayImage image);

/// Grey value between four pixels, by bilinear interpolation.
double greyAt(const GrayImage& image, const Eigen::Vector2d& at);

/// Offset [px] along `normal` from `at` of the step that has the profile's area: unlike a threshold
/// it is not moved by blur nor by the place of the pixels.
double edgeOffset(const GrayImage& image, const Eigen::Vector2d& at, const Eigen::Vector2d& normal);

}  // namespace ringhook
