#pragma once

/// \file
/// Second-order time steps for the swinging hooks. MuJoCo's semi-implicit Euler step,
///     v' = v + h a(q, v),   q' = q + h v',
/// is the leapfrog scheme (Stoermer and Verlet; Hairer, Lubich and Wanner, "Geometric numerical
/// integration illustrated by the Stoermer-Verlet method", Acta Numerica 2003) if v is read as the
/// velocity half a step ago. Only forces that depend on velocity then see the wrong one: Coriolis
/// terms of the two hinges make a hook that swings by 15 degrees in both planes gain 2 % of its
/// energy a minute at h = 0.5 ms. So a step runs on the staggered rates, and between steps
///     v(t) = v(t - h/2) + h/2 a(t - h)
/// stands in their place, for the forces and for whoever looks. What is left of that gain: see
/// doc/simulation.md. Arm, belt and rings are not touched: their motion is prescribed or dominated
/// by contacts.

namespace ringhook {

struct CellState;

/// Puts the staggered rates in; to be called right before mj_step2.
void beginLeap(CellState& cell);

/// Notes the new staggered rates and puts centred ones in their place; right after mj_step2. A hook
/// that was set swinging at this step's beginning makes half a step of velocity, since the rate it
/// was given is not staggered.
void endLeap(CellState& cell);

}  // namespace ringhook
