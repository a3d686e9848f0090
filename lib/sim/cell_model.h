#pragma once

/// \file
/// The cell as a MuJoCo model (MJCF text). Bodies: `link1..link6` (link6 carries the flange frame
/// e), `jaw_upper jaw_lower`, `belt`, `hook0..` (body frame = o), `ring0..` (body frame = r).
/// Joints: `j1..j6`, `upper lower`, `belt`, `hookN_x hookN_y` (swing about x_f, then y), `ringN`.
///
/// Arm: modified Denavit-Hartenberg chain (Craig, "Introduction to Robotics", 3rd ed., eq. 3.6)
/// with the figures of the RX60(B) arm manual; link shapes have true lengths, link masses and
/// rotor inertias are assumptions (the maker publishes none).
///
/// Gripper: a radial gripper, as sold for small parts: two short jaws above and below the rim,
/// each hinged 18 mm behind the wire. Closed they straddle the wire with 0.2 mm of air and a weld
/// constraint stands for the grip. Opening drops the weld and swings both jaws out by 90 degrees;
/// the lower jaw leaves several times faster than the ring can fall, ends 13 mm behind the ring and
/// hangs straight down there, so neither the fall nor the retreat along -x_f meets a jaw.
///
/// Ring: a torus of capsules for contact with hook and gripper; eight balls in the same wire meet
/// the floor (cheaper); mass and inertia are the true torus's.

#include <string>

#include "core/pose.h"
#include "sim/cell_draw.h"
#include "sim/cell_options.h"

namespace ringhook {

/// Ring in the flange while gripped: x_r = z_e, y_r = y_e, z_r = -x_e.
Pose gripPose(const CellOptions& options);

/// Where ring `index` waits in the feeder's magazine, in f.
Pose magazinePose(int index);

/// The whole model for mj_loadXML.
std::string cellModelXml(const CellOptions& options, const CellDraw& draw);

}  // namespace ringhook
