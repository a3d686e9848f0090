#include "cycle/hook_sight.h"

#include "core/error.h"
#include "tracking/edge_model.h"
#include "tracking/edge_tracker.h"
#include "tracking/hook_search.h"
#include "tracking/marker_tracker.h"
#include "tracking/tag_plate.h"

namespace ringhook {
namespace {

HookSight markerSight(const CellConfig& cell) {
  const TagPlate plate = loadTagPlate(cell.hook.plate);
  HookSight sight;
  for (const PlateTag& tag : plate.tags) {
    for (const Eigen::Vector3d& corner : tagCorners(plate, tag)) {
      sight.outline_o.push_back(corner);
    }
  }
  // The detector needs the white border around the black square: an eighth of its side, and some.
  sight.margin_px = 24.0;
  sight.tracker = std::make_unique<MarkerTracker>(plate);
  return sight;
}

SearchSpace searchSpace(const CellConfig& cell, const Pose& fMc1) {
  SearchSpace space;
  space.fMc1 = fMc1;
  space.pivot_start_f = cell.belt.pivot_start_f;
  space.belt_direction_f = cell.belt.direction_f;
  space.travel_from_m = cell.belt.search_from_m;
  space.travel_to_m = cell.belt.search_to_m;
  space.pivot_o = cell.hook.pivot_o;
  space.swing_x = cell.hook.swing_max_rad;
  space.swing_y = cell.hook.swing_max_rad;
  return space;
}

HookSight edgeSight(const CellConfig& cell, const Pose& fMc1) {
  const EdgeModel model = loadEdgeModel(cell.hook.model);
  HookSight sight;
  sight.outline_o = model.points;
  // The moving edges search along the normal of every model line.
  sight.margin_px = 16.0;
  sight.tracker = std::make_unique<EdgeTracker>(cell.hook.model);
  sight.find = [model, space = searchSpace(cell, fMc1)](const RectifiedFrame& frame) {
    return findHook(frame, model, space);
  };
  return sight;
}

}  // namespace

HookSight makeHookSight(const CellConfig& cell, const Pose& fMc1, TrackerKind kind) {
  return kind == TrackerKind::kMarker ? markerSight(cell) : edgeSight(cell, fMc1);
}

Pose requireRobotCamera(const StereoRig& rig, const std::filesystem::path& file) {
  if (!rig.right) {
    throw InputError(file.string() + ": key K2 is missing: the servo task needs two cameras");
  }
  if (!rig.fMc1) {
    throw InputError(file.string() +
                     ": key fMc1 is missing: calibrate the cameras against the robot first");
  }
  return *rig.fMc1;
}

}  // namespace ringhook
