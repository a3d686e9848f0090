#pragma once

/// \file
/// How the hook is seen, chosen once: by its tag plate, or by its edges. Both give the same
/// HookView; they differ in the tracker, in how a hook is found that nobody has seen before, and
/// in the part of the hook that must lie in the window.

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "core/outcome.h"
#include "core/stereo_frame.h"
#include "cycle/cell_config.h"
#include "rig/stereo_rig.h"
#include "tracking/hook_tracker.h"

namespace ringhook {

enum class TrackerKind { kMarker, kEdges };

struct HookSight {
  std::unique_ptr<HookTracker> tracker;
  /// Pose c1Mo of a hook in the search windows, without any start; empty if the tracker itself
  /// needs none.
  std::function<Outcome<Pose>(const RectifiedFrame&)> find;
  std::vector<Eigen::Vector3d> outline_o;  ///< corners of what the tracker looks at [m]
  double margin_px = 8.0;                  ///< around them, what the tracker needs besides
};

/// Loads the cell's plate or edge model. Throws InputError for bad files.
HookSight makeHookSight(const CellConfig& cell, const Pose& fMc1, TrackerKind kind);

/// fMc1 of a rig of two cameras; throws InputError naming `file` if the rig has none.
Pose requireRobotCamera(const StereoRig& rig, const std::filesystem::path& file);

}  // namespace ringhook
