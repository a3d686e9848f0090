#pragma once

/// \file
/// A point mass on a massless rod as MuJoCo simulates it, by three ways of stepping. It stands
/// beside the cell, to be compared with what theory says of it:
///     phi'' + D phi' + g / L sin(phi) = 0      (eq. 5.13 of the 2007 report, Jeyabalan)

#include <vector>

namespace ringhook {

enum class PendulumStepping {
  euler,     ///< MuJoCo's semi-implicit Euler, velocities as they come
  leapfrog,  ///< the same steps, velocities centred as in the cell (leapfrog.h)
  rk4,       ///< MuJoCo's Runge-Kutta method of fourth order
};

struct PendulumOptions {
  double length = 1.0;   ///< L [m]
  double mass = 1.0;     ///< [kg]
  double damping = 0.0;  ///< D [1/s]
  double start = 1.0;    ///< angle at time zero, at rest [rad]
  double step = 0.0005;  ///< [s]
  PendulumStepping stepping = PendulumStepping::leapfrog;
};

struct PendulumSample {
  double time_s = 0.0;
  double angle = 0.0;  ///< from hanging [rad]
  double rate = 0.0;   ///< [rad/s]
};

/// Samples at 0, step, 2 step, ... until `duration_s` [s]. Throws Error if MuJoCo refuses.
std::vector<PendulumSample> simulatePendulum(const PendulumOptions& options, double duration_s);

}  // namespace ringhook
