#pragma once

/// \file
/// The default hook as numbers (doc/frames.md), and the files made from them: the edge model for
/// ViSP's model-based tracker, a solid to look at, and the tag plate. One struct feeds them all,
/// so the tracker's model, the plate and the simulated hook cannot drift apart; a test compares
/// the stored files under datasets/models/hook with what these functions emit.
/// All coordinates are in the hook frame `o`: origin at the centre of the J's arc, x towards the
/// cameras, y towards the tip, z up along the shank.
/// Edge model format: ViSP 3.5 vpMbTracker::loadModel, "V1" (points, lines, faces, cylinders,
/// circles; a face is seen from the side where its points run counter-clockwise).

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/pose.h"

namespace ringhook {

struct HookShape {
  double bar_width = 0.012;       ///< of the bar in the y-z plane [m]
  double bar_thickness = 0.006;   ///< of the bar along x [m]
  double arc_radius = 0.035;      ///< of the J's centreline [m]
  double shank_length = 0.450;    ///< from z = 0 up to the pivot [m]
  double tip_rise = 0.025;        ///< tip's end above z = 0 [m]
  double plate_width = 0.054;     ///< tag plate along y [m]
  double plate_height = 0.108;    ///< tag plate along z [m]
  double plate_face_x = 0.005;    ///< printed face of the plate [m]; its back lies on the bar
  double plate_centre_z = 0.200;  ///< [m]; in y the plate is centred on the shank
  double tag_size = 0.040;        ///< side of the black square [m]
  double tag_distance = 0.054;    ///< between the centres of tag 0 (upper) and tag 1 [m]
  double tracked_top = 0.400;     ///< the edge model ends at this z [m]
  int arc_chords = 16;            ///< chords per side of the arc in the edge model

  /// Tag plate in the hook frame: x_k = y_o, y_k = -z_o, z_k = -x_o.
  [[nodiscard]] Pose oMk() const;
};

/// Throws InputError naming the measure that makes no hook, and what was expected of it.
void checkHookShape(const HookShape& shape);

/// Outline (y, z) [m] of the bar's front face from `top_z` down the outer side of the shank, round
/// the arc, across the tip's end and back up the inner side; counter-clockwise seen from +x. The
/// arc's inner vertices stand off the circle so that the chords' mean distance from it is zero.
std::vector<Eigen::Vector2d> barOutline(const HookShape& shape, double top_z, int arc_chords);

/// Edge model: the visible edges of bar and plate; no edge where the plate hides the shank and
/// none across the bar where it merely ends for the model.
std::string hookCao(const HookShape& shape);

/// Bar and plate as a Wavefront solid [m], for viewers.
std::string hookObj(const HookShape& shape);

/// Tag plate in the layout of doc/formats.md, with oMk.
std::string markerYaml(const HookShape& shape);

}  // namespace ringhook
