#pragma once

/// \file
/// The 2007 report's damped pendulum (Jeyabalan, Fork project, section 5.2) and its filter.
/// Linearised law (5.15, with the damping of 5.18): phi'' + (D/m) phi' + (g/L) phi = 0.
/// State (5.14): x = (phi [rad], v = L phi' [m/s]). The report discretises by differences, first
/// v from the old phi, then phi from the new v (5.18, 5.19), which gives the map (5.21)
///   A = [1 - g dt^2/L, (1 - D dt/m) dt/L;  -g dt, 1 - D dt/m].
/// This is the semi-implicit (symplectic) Euler map: det A = 1 - D dt/m, so without damping it
/// turns for ever on an ellipse. Its frequency w' obeys cos(w' dt) = 1 - g dt^2/(2L): the period is
/// short by the factor 1 - (w dt)^2/24, and its v belongs to dt/2 before its phi. Both vanish with
/// dt: durations are therefore walked in whole steps of the map's own sampling dt (2 ms by default,
/// not the frame time) and one shorter last step. Back in time goes the exact inverse.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/outcome.h"
#include "core/time.h"
#include "prediction/linear_kalman.h"

namespace ringhook {

struct PendulumParameters {
  double length_m = 1.0;          ///< effective length L: inertia / (mass * distance to its centre)
  double mass_kg = 1.0;           ///< m; only D/m acts
  double damping_kg_per_s = 0.0;  ///< D of equation 5.18
  double gravity = 9.81;          ///< g, the report's value [m/s^2]
  double step_s = 0.002;          ///< sampling dt of the map
};

/// The map (5.21) over one step of `dt` [s], dt >= 0.
Eigen::Matrix2d pendulumMap(const PendulumParameters& parameters, double dt);

/// A duration walked in steps of the map.
struct PendulumWalk {
  Eigen::Matrix2d transition;  ///< on (phi [rad], v [m/s])
  Eigen::Matrix2d noise;       ///< covariance gathered on the way, same units
};

/// Walks `duration` [s], negative for back in time. `acceleration_density` [rad^2/s^3] is white
/// noise on phi'' and stands for all that the model leaves out.
PendulumWalk walkPendulum(const PendulumParameters& parameters, double duration,
                          double acceleration_density);

/// Angular frequency w' [rad/s] of the undamped map: cos(w' dt) = 1 - g dt^2/(2L).
double mapFrequency(const PendulumParameters& parameters);

/// The report's simulation (section 5.2.2): the nonlinear difference equations, 5.18 and 5.19 with
/// sin(phi), or the linear map, from rest at `phi0` [rad]. Returns (phi, v) at 0, dt, ... steps*dt.
enum class PendulumLaw { kLinear, kNonlinear };
std::vector<Eigen::Vector2d> simulatePendulum(const PendulumParameters& parameters, PendulumLaw law,
                                              double phi0, int steps);

struct PendulumFilterOptions {
  PendulumParameters pendulum;
  double acceleration_density = 1e-4;  ///< white noise on phi'' [rad^2/s^3]
  double rate_sigma = 2.0;             ///< prior of phi', mean 0 [rad/s]
  double gate_probability = 0.0;       ///< of a good measurement to pass, in (0, 1); 0: no gate
};

/// Filter of one swing angle about a fixed pivot, hanging = 0.
class PendulumFilter {
 public:
  explicit PendulumFilter(const PendulumFilterOptions& options);

  /// Angle [rad] with variance [rad^2] at `time`. Refuses "not finite", "late or duplicate time
  /// stamp", "outside the gate"; the belief stays as it was.
  Outcome<FilterUpdate> update(Time time, double angle, double variance);

  /// Belief on (phi [rad], v [m/s]) at `time`, later or slightly earlier; refuses "no measurement
  /// yet".
  [[nodiscard]] Outcome<Gaussian<2>> predict(Time time) const;

 private:
  [[nodiscard]] Gaussian<2> ahead(Time time) const;

  PendulumFilterOptions options_;
  double gate_ = 0.0;  ///< on the NIS; 0: none
  std::optional<Time> time_;
  Gaussian<2> belief_;
};

}  // namespace ringhook
