#pragma once

/// \file
/// The nonlinear spherical pendulum as a motion model: the swing filter (swing_filter.h) on angles,
/// points, and points with their pivots, of which nothing is known beforehand. Angles hang at zero
/// about a pivot at rest. A point's pivot travels evenly, as below a belt, and changes of speed and
/// bumps are told from outliers. A pivot that is seen moves as its own track says (singer_bank.h).

#include <memory>

#include "prediction/motion_model.h"
#include "prediction/swing_start.h"

namespace ringhook {

struct SwingMotionOptions {
  double sample_sigma = 1e-3;  ///< measurement noise of each number [rad or m], > 0
  double gravity = 9.81;       ///< [m/s^2]
};

/// What is believed of a recording before its first sample: next to nothing.
SwingPrior unknownSwing(TrajectoryKind kind);

/// "spherical-pendulum".
std::unique_ptr<MotionModel> makeSwingMotion(TrajectoryKind kind,
                                             const SwingMotionOptions& options);

}  // namespace ringhook
