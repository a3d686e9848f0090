#pragma once

/// \file
/// The hook of datasets/models painted as two flat figures, with or without its tags.

#include <string>

#include "tests/support/scene_painter.h"
#include "tracking/edge_model.h"
#include "tracking/tag_plate.h"

namespace ringhook::test {

inline std::string hookModelPath() {
  return std::string(RINGHOOK_SOURCE_DIR) + "/datasets/models/hook/hook.cao";
}
inline std::string hookPlatePath() {
  return std::string(RINGHOOK_SOURCE_DIR) + "/datasets/models/hook/marker.yaml";
}

/// Plane x_o = depth, its own x along y_o and its y along -z_o.
Pose planeInHook(double depth_m);

/// Paints bar and plate into both views.
void paintHook(RectifiedFrame& frame, const Pose& c1Mo, double bar_grey, double plate_grey);

/// Paints the tags of a plate into both views.
void paintTags(RectifiedFrame& frame, const TagPlate& plate, const Pose& c1Mo);

/// Cuts every view to the window around a point given in c1.
void cutWindows(RectifiedFrame& frame, const Eigen::Vector3d& centre_c1, int width, int height);

}  // namespace ringhook::test
