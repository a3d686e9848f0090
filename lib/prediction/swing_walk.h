#pragma once

/// \file
/// The swing's state and belief at another instant. The mean follows the law by the classical
/// Runge-Kutta method of fourth order, and with it the state transition Phi by the variational
/// equation Phi' = F(t) Phi (Jazwinski, 1970, section 8.3), through the same four stages. Process
/// noise is Van Loan's integral (IEEE Trans. AC-23, 1978)
///   Q = integral over s from 0 to h of exp(F s) G S G^T exp(F s)^T ds
/// by Gauss and Legendre with three nodes: exact for the chain A -> v -> p, and never indefinite.
/// What the pivot's unknown acceleration does to pivot and swing enters jointly, as it does in
/// physics: a belt that stops makes the hook swing.

#include <Eigen/Core>

#include "prediction/swing_law.h"
#include "prediction/swing_state.h"

namespace ringhook {

/// Spectral densities of what the law leaves out.
struct SwingNoise {
  Eigen::Vector3d pivot_acceleration = Eigen::Vector3d::Constant(3e-4);  ///< Singer's standard
                                                                         ///< deviation, f [m/s^2]
  double swing_density = 1e-9;    ///< white, on both angular accelerations [rad^2/s^3]
  double length_density = 0.0;    ///< walk of ln length [1/s]
  double damping_density = 1e-8;  ///< walk of the viscous damping [1/s^3]
  double dry_density = 1e-9;      ///< walk of the dry friction [rad^2/s^5]
  double longer_density = 0.0;    ///< walk of longer [m^2/s]
  double rest_density = 1e-10;    ///< walk of the rest angles [rad^2/s]
  double yaw_density = 1e-8;      ///< walk of the yaw [rad^2/s]
};

/// One stretch of time walked: where the mean went and how neighbours of it go.
struct SwingTransition {
  SwingVector state;  ///< at the end
  SwingMatrix Phi;    ///< d end / d start
};

/// Longest step [s] that keeps the error of one swing below 1e-6 of its amplitude: 0.2 / w.
double longestSwingStep(const SwingVector& state, const SwingLaw& law);

/// State `dt` [s] later, earlier when negative.
SwingVector walkSwing(const SwingVector& state, double dt, const SwingLaw& law);

/// The same with its transition.
SwingTransition walkSwingWithTransition(const SwingVector& state, double dt, const SwingLaw& law);

/// Belief `dt` [s] later; earlier when negative, with noise added as for |dt|.
SwingBelief walkSwingBelief(const SwingBelief& belief, double dt, const SwingLaw& law,
                            const SwingNoise& noise);

/// The same and the transition it used, for a smoother.
struct SwingBeliefWalk {
  SwingBelief belief;
  SwingMatrix Phi;
};
SwingBeliefWalk walkSwingBeliefWithTransition(const SwingBelief& belief, double dt,
                                              const SwingLaw& law, const SwingNoise& noise);

}  // namespace ringhook
