#pragma once

/// \file
/// Named simulated cells, as YAML: what app/config/scenarios/*.yaml hold. Units are in the keys
/// (_m, _deg, _m_s ...); a key left out keeps the default of the option it stands for; an unknown
/// one is refused. Sections: belt, hook, ring, arm, gripper, air (cell_options.h); light,
/// background, occluder, board (scene_options.h); camera (sim_stereo_camera.h); calibration
/// (RigErrors of nominal_rig.h). Every key and its range: doc/simulation.md.
///
///     name: easy
///     belt: {speed_m_s: 0.05, speed_spread: 0.02}
///     hook: {count: 3, swing_about_x_deg: 3.0}
///     ring: {clearance_m: 0.013}

#include <filesystem>
#include <string>

#include "sim/cell_options.h"
#include "sim/nominal_rig.h"
#include "sim/sim_stereo_camera.h"

namespace ringhook {

struct Scenario {
  std::string name;
  CellOptions cell;  ///< with the scene
  SimCameraOptions camera;
  RigErrors calibration;  ///< by how much the true rig differs from what the loop is told
};

/// Throws InputError naming file, line and field.
Scenario loadScenario(const std::filesystem::path& path);

}  // namespace ringhook
