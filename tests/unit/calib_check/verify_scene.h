#pragma once

/// \file
/// Views of a flat board of 9x6 points, 30 mm apart, as a rig that is known would see them.

#include <cstdint>
#include <vector>

#include "calib/solve/verify_fit.h"

namespace ringhook {

/// The default cell's cameras with lens distortion, and evidence for noise of 0.05 px per axis.
StereoRig acceptedRig();

/// The same rig whose right camera has turned [rad] and shifted [m] in its own frame.
StereoRig movedRig(const Eigen::Vector3d& rotation_rad, const Eigen::Vector3d& translation_m);

std::vector<Eigen::Vector3d> boardPoints();

/// Views of a board in many places and tilts about 1.3 m away, as `rig` sees them with this noise
/// per pixel axis [px]. \param reach largest offset from the middle of the field [m].
std::vector<SightedView> viewsBy(const StereoRig& rig, int count, double sigma_px,
                                 std::uint64_t seed, double reach_m = 0.12);

}  // namespace ringhook
