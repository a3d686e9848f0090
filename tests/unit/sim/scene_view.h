#pragma once

/// \file
/// What the image tests share: a world with a hook in view, its newest frame, and where the lens
/// model alone puts points of hook and plates.

#include <vector>

#include "camera/stereo_camera.h"
#include "rig/stereo_rig.h"
#include "sim/cell_world.h"
#include "sim/tag_pattern.h"

namespace ringhook {

/// A world whose first hook hangs in front of the cameras from the start, its pivot at y_f [m].
CellOptions hookInView(double start_y);

/// The last frame that has arrived by then. Throws Error if there is none.
StereoFrame frameAt(CellWorld& world, StereoCamera& camera, double time_s);

/// Pixel of a point by the lens model alone.
Eigen::Vector2d projected(const CameraModel& camera, const Pose& cMa,
                          const Eigen::Vector3d& point_a);

/// Corners of the black square of a plate's tag in the plate's frame [m], upper left first, then
/// clockwise as one reads it. \param place 0 is the upper tag.
std::vector<Eigen::Vector3d> tagCornersOnPlate(const TagPlateFace& face, std::size_t place);

/// Corners of the hook's tag `id` in o.
std::vector<Eigen::Vector3d> tagCorners(int id);

/// A square window around a point, inside the full image.
Window around(const Eigen::Vector2d& point, int side);

}  // namespace ringhook
