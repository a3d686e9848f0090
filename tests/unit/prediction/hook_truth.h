#pragma once

/// \file
/// An independent truth for the hook filter: a nonlinear compound pendulum that swings freely in
/// both planes under a moving pivot, integrated by RK4 on the shank's direction u (unit vector),
/// with viscous and dry friction; and noisy fixes of it. No angle, no small-angle law, no filter
/// code: u'' = -|u'|^2 u + (I - u u^T)(g_vec / L) - c u' - k u'/|u'|.

#include <Eigen/Core>
#include <random>
#include <vector>

#include "core/hook_values.h"

namespace ringhook {

struct HookTruthOptions {
  double length = 0.357;     ///< effective length [m]; the filter believes 0.35
  double swing = 0.0524;     ///< amplitude in each plane [rad]
  double phase = 0.7;        ///< of the first plane at the start [rad]
  double belt_speed = 0.05;  ///< along y [m/s]
  double viscous = 0.03;     ///< c [1/s]
  double dry = 0.01;         ///< k [rad/s^2]
  double tilt_x = 0.008;     ///< the hook hangs tilted in its suspension [rad]
  double tilt_y = -0.005;    ///< [rad]
  double yaw = 0.05;         ///< [rad]
  Eigen::Vector3d pivot_o{0.0, -0.02, 0.45};
  double position_sigma = 2e-4;  ///< of a fix, per axis [m]
  double rotation_sigma = 1e-3;  ///< of a fix, per axis [rad]
};

/// True poses fMo every `step` [s].
std::vector<Pose> simulateHook(const HookTruthOptions& options, double step, int count);

/// Noisy fix of fMo as seen by the camera at fMc1.
HookFix noisyFix(const HookTruthOptions& options, const Pose& fMc1, const Pose& fMo, double time_s,
                 std::mt19937& random);

/// The camera of the default cell, roughly.
Pose testCamera();

}  // namespace ringhook
