#pragma once

/// \file
/// What a calibrated rig makes of a point that the cameras really see: truth and estimate of a
/// stereo rig compared where it counts, in space.

#include "rig/stereo_rig.h"

namespace ringhook::test {

/// Pixel of a point given in a camera's own frame c [m], lens included.
Eigen::Vector2d imageOf(const CameraModel& camera, const Eigen::Vector3d& point_c);

/// Point in c1 [m] that `rig` triangulates from two pixels of the full images. Throws Error for
/// pixels beyond the lens model.
Eigen::Vector3d triangulatedBy(const StereoRig& rig, const Eigen::Vector2d& left,
                               const Eigen::Vector2d& right);

/// Where `rig` measures a point that stands at `point_c1` in the true left camera [m].
Eigen::Vector3d measuredBy(const StereoRig& rig, const StereoRig& truth,
                           const Eigen::Vector3d& point_c1);

}  // namespace ringhook::test
