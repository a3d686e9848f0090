#pragma once

/// \file
/// How the simulated cell looks: lamps, background, clutter, what passes in front of the cameras,
/// and a calibration board. Plain values with the default cell's figures; every seed makes the
/// actual scene differ a little (cell_visuals.h, scene_light.h). Nothing here touches the physics.

#include <cstdint>

#include "core/pose.h"

namespace ringhook {

/// hall: rows of lamps overhead, one in front of the cell; shadows brightened from all sides.
/// side: one strong lamp beside the cell, little else; hard, deep shadows.
enum class LightSetup { hall, side };

struct LightOptions {
  LightSetup setup = LightSetup::hall;
  /// Factor on all light in the cell, at the default exposure; a dark hall has 0.05 to 0.2.
  double brightness = 1.0;
  double brightness_spread = 0.08;  ///< each lamp's own factor is 1 + uniform(-s, +s)
  double direction_spread = 0.05;   ///< each lamp stands turned by up to this [rad]
  bool shadows = true;
  int shadow_map_px = 2048;  ///< side of the shadow map, 256 to 4096; sets its sharpness [px]
};

/// plain: a mildly stained wall. textured: panels, joints and stains of strong contrast.
enum class WallKind { plain, textured };

/// Things that pass between cameras and hook, one after the other: rods that hang from a carrier
/// of their own and travel along y_f against the belt.
struct OccluderOptions {
  int count = 0;               ///< how many pass in all
  double speed = 0.30;         ///< along -y_f [m/s]
  double speed_spread = 0.20;  ///< each one's own factor is 1 + uniform(-s, +s)
  double width = 0.030;        ///< of the rod [m]
  double x = 0.80;             ///< plane x_f in which they pass; hooks hang at 0.42 [m]
  double first_s = 4.0;        ///< the first one crosses y_f = 0 at this time [s]
  double interval_s = 5.0;     ///< from one crossing of y_f = 0 to the next [s]
};

/// Checkerboard for calibration (frame t of doc/frames.md), one white square around it; none if
/// columns or rows is 0. CellWorld::holdBoard puts it elsewhere.
struct BoardOptions {
  int columns = 0;              ///< inner corners along x_t
  int rows = 0;                 ///< inner corners along y_t
  double square = 0.025;        ///< side of a square [m]
  Pose fMt = Pose::Identity();  ///< board in f at time zero; printed side seen from -z_t
};

struct SceneOptions {
  std::uint64_t seed = 0;  ///< of lamps, wall, clutter and occluders; 0: the cell's own seed
  LightOptions light;
  WallKind wall = WallKind::plain;
  int clutter = 0;        ///< boxes, pipes, cables and other hooks behind the belt, 0 to 60
  double specular = 1.0;  ///< factor on the steel's highlights; 0 makes everything matt
  OccluderOptions occluder;
  BoardOptions board;
};

}  // namespace ringhook
