#pragma once

/// \file
/// One hook below a belt and nothing else: the cell's physics of both (mass, hinges, friction, air;
/// MuJoCo) without arm, rings and images, so that thousands of swings can be had. What comes out is
/// the truth: for tests and evaluation only (the macro of sim/truth.h guards it likewise).

#ifndef RINGHOOK_TRUTH_ALLOWED
#error "sim/hook_world.h is ground truth: link ringhook::truth (tests, evaluation, app)"
#endif

#include <vector>

#include "core/pose.h"
#include "sim/belt_profile.h"
#include "sim/cell_draw.h"

namespace ringhook {

/// Something strikes the hook: its swing rates jump.
struct HookBlow {
  double time_s = 0.0;                 ///< [s]
  double rate_change[2] = {0.0, 0.0};  ///< about x_f, y [rad/s]
};

struct HookWorldOptions {
  HookDraw hook;                              ///< swing at time zero included
  BeltProfile belt;                           ///< along +y_f
  Eigen::Vector3d pivot_f{0.42, -0.5, 1.05};  ///< at time zero [m]
  double air_density = 1.2;                   ///< [kg/m^3]
  double air_viscosity = 1.8e-5;              ///< [Pa s]
  double physics_step = 0.001;                ///< of MuJoCo's fourth-order Runge-Kutta [s]
  std::vector<HookBlow> blows;                ///< in the order of time
};

/// The hook at one instant.
struct HookWorldSample {
  double time_s = 0.0;
  Pose fMo = Pose::Identity();
  Eigen::Vector3d pivot_f = Eigen::Vector3d::Zero();  ///< [m]
  double angle[2] = {0.0, 0.0};                       ///< swing about x_f, then y; hanging 0 [rad]
};

/// Samples at 0, `sample_s`, ... up to `duration_s` [s]; `sample_s` is rounded to whole physics
/// steps. Throws Error if MuJoCo refuses the model.
std::vector<HookWorldSample> simulateHookWorld(const HookWorldOptions& options, double duration_s,
                                               double sample_s);

}  // namespace ringhook
