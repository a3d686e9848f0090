#include "sim/hook_air.h"
#include "core/angle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "quiet_cell.h"
#include "sim/cell_world.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

/// One hook on a standing belt that swings in one plane and is braked by the air alone.
CellOptions inAir(int axis, double swing) {
  CellOptions options = quietCell();
  options.air_density = CellOptions{}.air_density;
  options.air_viscosity = CellOptions{}.air_viscosity;
  (axis == 0 ? options.hook.swing_about_x : options.hook.swing_about_y) = swing;
  return options;
}

struct Decay {
  double first = 0.0;  ///< amplitude at the first turning point [rad]
  double last = 0.0;   ///< ten periods later [rad]
};

Decay decay(const CellOptions& options, int axis) {
  CellWorld world(options);
  Decay result;
  double before = truth(world).hooks[0].twist_f[3 + axis];
  for (int turns = 0; turns < 21;) {
    world.advanceTo(world.time() + 0.002);
    const HookTruth hook = truth(world).hooks[0];
    const double rate = hook.twist_f[3 + axis];
    if ((before > 0.0) != (rate > 0.0)) {
      result.last = std::abs(axis == 0 ? hook.swing_about_x : hook.swing_about_y);
      result.first = turns == 0 ? result.last : result.first;
      ++turns;
    }
    before = rate;
  }
  return result;
}

double cube(double r) { return r * r * r; }

/// Integral of r^3 over a straight bar from r = a to b below the pivot.
double cubed(double a, double b) { return 0.25 * (b * b * b * b - a * a * a * a); }

/// Drag torque over the square of the rate for swings towards the cameras, by hand: every face is
/// square to the flow, and the speed is the rate times the depth below the pivot.
double torqueTowardsCameras() {
  const double shank = cubed(0.0, 0.196) + cubed(0.304, 0.450);
  const double tip = cubed(0.425, 0.450);
  double arc = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double angle = std::numbers::pi * (i + 0.5) / 1000.0;
    arc += cube(0.450 + 0.035 * std::sin(angle)) * 0.035 * std::numbers::pi / 1000.0;
  }
  const double bars = 2.0 * 0.012 * (shank + tip + arc);
  const double plate = 1.2 * 0.054 * cubed(0.196, 0.304);
  return 0.5 * 1.2 * (bars + plate);
}

TEST(HookAir, BrakesLikeTheDragEquationOnTheHooksFaces) {
  const double swing = 12.0 * kDegree;
  const Decay air = decay(inAir(1, swing), 1);
  // A torque of c rate^2 takes 8/3 c A / I of the amplitude A a period; so 1/A grows evenly.
  const HookMass hook = hookMass();
  const Eigen::Vector3d arm = hook.center_o - hookPivot(0.450);
  const double inertia = hook.inertia_o(1, 1) + hook.mass * arm.squaredNorm();
  const double growth = (1.0 / air.last - 1.0 / air.first) / 10.0;
  const double expected = 8.0 / 3.0 * torqueTowardsCameras() / inertia;
  std::printf("1/A grows by %.5f a period, by hand %.5f\n", growth, expected);
  EXPECT_NEAR(growth, expected, 0.05 * expected);
}

TEST(HookAir, DragIsQuadraticAndWeakerEdgeOn) {
  const Decay wide = decay(inAir(1, 12.0 * kDegree), 1);
  const Decay narrow = decay(inAir(1, 3.0 * kDegree), 1);
  const auto loss = [](const Decay& d) { return std::log(d.first / d.last); };
  // The decrement is proportional to the amplitude.
  EXPECT_NEAR(loss(wide) / loss(narrow), wide.first / narrow.first,
              0.1 * wide.first / narrow.first);
  const Decay edge_on = decay(inAir(0, 12.0 * kDegree), 0);
  EXPECT_LT(loss(edge_on), 0.7 * loss(wide));
  EXPECT_GT(loss(edge_on), 0.2 * loss(wide));
}

TEST(HookAir, InAVacuumNothingIsLost) {
  CellOptions options = inAir(1, 12.0 * kDegree);
  options.air_density = options.air_viscosity = 0.0;
  const Decay none = decay(options, 1);
  EXPECT_NEAR(none.last, none.first, 1e-4 * none.first);
}

TEST(HookAir, TheDefaultHooksQualityFactorIsPrinted) {
  for (int axis = 0; axis < 2; ++axis) {
    CellOptions options = inAir(axis, 8.0 * kDegree);
    options.hook.damping_spread = 0.0;
    options.hook.pivot_friction = CellOptions{}.hook.pivot_friction;
    options.hook.pivot_damping = CellOptions{}.hook.pivot_damping;
    const Decay all = decay(options, axis);
    const double decrement = std::log(all.first / all.last) / 10.0;
    std::printf("8 deg about %c: decrement %.4f a period, quality factor %.0f\n", "xy"[axis],
                decrement, std::numbers::pi / decrement);
    EXPECT_GT(decrement, 0.010);
    EXPECT_LT(decrement, 0.025);
  }
}

}  // namespace
}  // namespace ringhook
