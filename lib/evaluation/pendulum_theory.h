#pragma once

/// \file
/// What is known of a pendulum without simulating it.
/// Exact period at amplitude a: T = T0 / agm(1, cos(a / 2)), T0 the period of small swings (Gauss;
/// Nelson and Olsson, "The pendulum: rich physics from a simple system", Am. J. Phys. 54, 1986).
/// The 2007 report (Jeyabalan, Fork project, section 5.2) linearises, sin(phi) = phi, and steps
///     v' = (1 - D dt / m) v - g dt phi,   phi' = phi + dt v' / L          (eqs. 5.18 to 5.21)
/// with the tangential speed v = L phi'.

#include <vector>

#include "sim/pendulum_world.h"

namespace ringhook {

/// Period [s] of an undamped pendulum at `amplitude` [rad] in (-pi, pi).
/// \param small_period of small swings, 2 pi sqrt(L / g) for a point mass [s]
double exactPeriod(double small_period, double amplitude);

/// The report's map from its start at rest: samples `dt` [s] apart until `duration_s` [s]; the rate
/// is v / L.
std::vector<PendulumSample> reportPendulum(const PendulumOptions& options, double dt,
                                           double duration_s);

/// The differential equation itself, by a Runge-Kutta method of fourth order with steps of 0.1 ms,
/// sampled `sample_s` [s] apart (whole steps).
std::vector<PendulumSample> referencePendulum(const PendulumOptions& options, double sample_s,
                                              double duration_s);

/// Mean time between upward passages through the lowest point [s]; crossings between samples are
/// found on the cubic through both samples and rates. NaN with fewer than two passages.
double measuredPeriod(const std::vector<PendulumSample>& samples);

/// Energy over m L^2: rate^2 / 2 + g / L (1 - cos angle) [1/s^2].
double pendulumEnergy(const PendulumOptions& options, const PendulumSample& sample);

}  // namespace ringhook
