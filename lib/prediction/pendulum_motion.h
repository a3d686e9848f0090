#pragma once

/// \file
/// Linear pendulums as motion models: the 2007 report's, with its own map and the frame time as the
/// map's step (Jeyabalan, Fork project, equations 5.18 to 5.21; pendulum.h), and the same law
/// discretised exactly (exact_pendulum.h). Both know length and damping as constants: told, or
/// found in the first seconds (pendulum_start.h), when they begin.
///
/// Angles are swung as they are, axis by axis. Points swing in x and y about a pivot:
///   measured pivot: state (p, v, a, s, s'), the point at p + s, pivot and point measured;
///   point alone: state (p, v, s, s'), p + s measured; what travels evenly is the pivot.
/// The report moves belt and hook as two separate models; the exact one lets the pivot's
/// acceleration drive the swing, as it does in a linear law. Height is a coordinate of its own,
/// with nearly constant velocity: to first order a swing does not change it.

#include <memory>
#include <optional>

#include "prediction/motion_model.h"

namespace ringhook {

struct PendulumMotionOptions {
  double sample_sigma = 1e-3;      ///< measurement noise of each number [rad or m], > 0
  double gravity = 9.81;           ///< [m/s^2]
  double frame_s = 0.02;           ///< time between samples: the step of the report's map, > 0
  std::optional<double> length_m;  ///< effective, > 0; without it both are found
  double damping_per_s = 0.0;      ///< c of phi'' = -(g/L) phi - c phi', with length_m
  double swing_density = 1.0;      ///< white acceleration of the swing [rad^2/s^3 or m^2/s^3]
  double pivot_density = 1.0;      ///< of a point's pivot: white jerk if measured [m^2/s^5], else
                                   ///< white acceleration [m^2/s^3]
  double height_density = 1.0;     ///< of a point: white acceleration of its height [m^2/s^3]
};

/// "report-pendulum".
std::unique_ptr<MotionModel> makeReportPendulum(TrajectoryKind kind,
                                                const PendulumMotionOptions& options);
/// "exact-pendulum".
std::unique_ptr<MotionModel> makeExactPendulum(TrajectoryKind kind,
                                               const PendulumMotionOptions& options);

}  // namespace ringhook
