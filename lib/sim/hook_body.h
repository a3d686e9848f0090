#pragma once

/// \file
/// The default hook as solid: which bars it is made of, what they weigh and where it has to hang so
/// that it hangs straight. Lengths come from HookShape, in the hook frame o. The aluminium tag
/// plate sits on the shank's camera side; a steel strip behind the shank balances it, so that the
/// centre of mass lies in the plane x_o = 0. Compound pendulum: a body of mass m hung at distance d
/// from its centre of mass swings with period 2 pi sqrt(I / (m g d)) for small angles, I taken
/// about the axis of the hinge.

#include <Eigen/Core>
#include <vector>

#include "sim/hook_shape.h"

namespace ringhook {

inline constexpr double kSteelDensity = 7850.0;  ///< [kg/m^3]
inline constexpr double kGravity = 9.81;         ///< [m/s^2]

/// A box of the hook, turned about x_o.
struct HookPart {
  Eigen::Vector3d center_o;   ///< [m]
  Eigen::Vector3d half_size;  ///< along its own axes [m]
  double angle_x = 0.0;       ///< turn about x_o [rad]
  double mass = 0.0;          ///< [kg]
};

/// Mass, centre of mass and inertia of the hook.
struct HookMass {
  double mass = 0.0;          ///< [kg]
  Eigen::Vector3d center_o;   ///< centre of mass [m]
  Eigen::Matrix3d inertia_o;  ///< about the centre of mass, axes of o [kg m^2]
};

/// Bars that the ring may touch: shank, arc, tip.
std::vector<HookPart> hookBars(const HookShape& shape = {});
/// The tag plate and the balancing strip behind the shank.
std::vector<HookPart> hookPlates(const HookShape& shape = {});
/// Of all parts together.
HookMass hookMass(const HookShape& shape = {});

/// Pivot in o for a hook whose pivot is `height` [m] above o: straight above the centre of mass.
Eigen::Vector3d hookPivot(double height);
/// Small-swing angular frequency [rad/s] about the hinge axis x (0) or y (1) through that pivot.
double swingFrequency(double height, int axis);

/// Centreline of the bar in o [m], from the tip around the J to the shank's upper end.
std::vector<Eigen::Vector3d> hookCentreline(const HookShape& shape = {});

}  // namespace ringhook
