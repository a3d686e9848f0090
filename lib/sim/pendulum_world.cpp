#include "sim/pendulum_world.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "sim/hook_body.h"
#include "sim/mujoco_model.h"

namespace ringhook {
namespace {

std::string pendulumXml(const PendulumOptions& o) {
  const bool rk4 = o.stepping == PendulumStepping::rk4;
  // MuJoCo wants some inertia; this much is a millionth of a millionth of the mass's about the
  // pivot.
  const double inertia = 1e-12 * o.mass * o.length * o.length;
  std::ostringstream text;
  text << std::setprecision(17) << "<mujoco><compiler boundinertia=\"0\"/><option timestep=\""
       << o.step << "\" integrator=\"" << (rk4 ? "RK4" : "Euler") << "\" gravity=\"0 0 "
       << -kGravity << "\"/><worldbody><body><joint type=\"hinge\" axis=\"0 -1 0\" damping=\""
       << o.damping * o.mass * o.length * o.length << "\"/><inertial pos=\"0 0 " << -o.length
       << "\" mass=\"" << o.mass << "\" diaginertia=\"" << inertia << ' ' << inertia << ' '
       << inertia << "\"/></body></worldbody></mujoco>";
  return text.str();
}

/// Rate half a step ago, from the one at the start.
double staggeredStart(const mjModel& model, mjData& data, double step) {
  mj_forward(&model, &data);
  return data.qvel[0] - 0.5 * step * data.qacc[0];
}

}  // namespace

std::vector<PendulumSample> simulatePendulum(const PendulumOptions& options, double duration_s) {
  const ModelPtr model = loadModel(pendulumXml(options));
  const DataPtr data = makeData(*model);
  const bool centred = options.stepping == PendulumStepping::leapfrog;
  data->qpos[0] = options.start;
  double staggered = staggeredStart(*model, *data, options.step);
  std::vector<PendulumSample> samples{{0.0, options.start, 0.0}};
  const long count = std::lround(duration_s / options.step);
  for (long i = 1; i <= count; ++i) {
    mj_step1(model.get(), data.get());
    if (centred) {
      data->qvel[0] = staggered;
      mj_step2(model.get(), data.get());
      const double half_kick = 0.5 * (data->qvel[0] - staggered);
      staggered = data->qvel[0];
      data->qvel[0] += half_kick;
    } else {
      mj_step(model.get(), data.get());
    }
    samples.push_back({static_cast<double>(i) * options.step, data->qpos[0], data->qvel[0]});
  }
  checkHealth(*data);
  return samples;
}

}  // namespace ringhook
