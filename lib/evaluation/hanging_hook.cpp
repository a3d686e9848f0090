#include "evaluation/hanging_hook.h"

#include <cmath>

#include "sim/cell_world.h"
#include "sim/hook_body.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

/// Kinetic and potential energy of the hook, zero when it hangs still [J].
double mechanicalEnergy(const HookTruth& hook, const HookMass& body) {
  const Eigen::Vector3d rotation = hook.twist_f.tail<3>();
  const Eigen::Vector3d arm = hook.fMo.linear() * body.center_o;
  const Eigen::Vector3d velocity = hook.twist_f.head<3>() + rotation.cross(arm);
  const Eigen::Vector3d rotation_o = hook.fMo.linear().transpose() * rotation;
  const Eigen::Vector3d center_f = hook.fMo * body.center_o;
  const double lowest = hook.fMp.translation().z() - (center_f - hook.fMp.translation()).norm();
  return 0.5 * body.mass * velocity.squaredNorm() +
         0.5 * rotation_o.dot(body.inertia_o * rotation_o) +
         body.mass * kGravity * (center_f.z() - lowest);
}

}  // namespace

CellOptions hangingHookCell(double swing_about_x, double swing_about_y) {
  CellOptions options;
  options.air_density = options.air_viscosity = 0.0;
  options.hook.count = 1;
  options.hook.swing_about_x = swing_about_x;
  options.hook.swing_about_y = swing_about_y;
  options.hook.pivot_friction = options.hook.pivot_damping = 0.0;
  options.hook.length_spread = options.hook.damping_spread = 0.0;
  options.belt.speed = options.belt.start_y = options.belt.entry_y = 0.0;
  options.ring.count = 1;
  return options;
}

HangingHookRun runHangingHook(const CellOptions& options, double duration_s) {
  CellWorld world(options);
  const HookMass body = hookMass();
  HangingHookRun run;
  const auto note = [&](Time now) {
    const HookTruth hook = truth(world).hooks.front();
    run.about_x.push_back({now.seconds(), hook.swing_about_x, hook.twist_f[3]});
    run.energy.push_back(mechanicalEnergy(hook, body));
  };
  world.every(options.physics_step, 0.0, note);
  world.advanceTo(Time::fromSeconds(duration_s));
  return run;
}

std::vector<double> turningPoints(const std::vector<PendulumSample>& samples) {
  std::vector<double> amplitudes;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double before = samples[i - 1].rate;
    const double now = samples[i].rate;
    if ((before > 0.0) != (now > 0.0)) {
      // The angle is flat here: the rate's zero lies `part` of a step on.
      const double part = before / (before - now);
      const double h = samples[i].time_s - samples[i - 1].time_s;
      amplitudes.push_back(std::abs(samples[i - 1].angle + 0.5 * before * part * h));
    }
  }
  return amplitudes;
}

}  // namespace ringhook
