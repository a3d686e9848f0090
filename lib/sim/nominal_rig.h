#pragma once

/// \file
/// The default cell's cameras. The nominal rig is what the loop is told (app/config/rig-sim.yaml,
/// which a test compares with what this code emits); the true rig is the nominal one disturbed by
/// the seed, since no calibration is perfect: the estimator never shares the truth.

#include <cstdint>

#include "rig/stereo_rig.h"

namespace ringhook {

/// Two 2048 x 2048 cameras, f = 2500 px, 0.40 m apart along the belt, looking from x = 1.75 m at
/// (0.42, 0, 0.70) m in f.
StereoRig nominalRig();

/// Standard deviations per axis of what calibration left undone.
struct RigErrors {
  double between_m = 0.00002;    ///< right camera in the left one [m]
  double between_rad = 0.00001;  ///< [rad]
  double to_robot_m = 0.0001;    ///< left camera in f [m]
  double to_robot_rad = 0.0001;  ///< [rad]
};

/// The rig as it truly stands.
StereoRig disturbedRig(const StereoRig& nominal, std::uint64_t seed, const RigErrors& errors = {});

}  // namespace ringhook
