#include "sim/hook_world.h"

#include <cmath>
#include <sstream>

#include "sim/hook_air.h"
#include "sim/hook_body.h"
#include "sim/hook_hinges.h"
#include "sim/mjcf_text.h"
#include "sim/mujoco_model.h"

namespace ringhook {
namespace {

constexpr double kBeltMass = 1e6;  // [kg]; no hook moves it

std::string hookWorldXml(const HookWorldOptions& o) {
  const Eigen::Vector3d pivot_o = hookPivot(o.hook.pivot_height);
  std::ostringstream text;
  text << "<mujoco><compiler angle=\"radian\"/><option integrator=\"RK4\" solver=\"Newton\""
       << attribute("timestep", o.physics_step) << attribute("density", o.air_density)
       << attribute("viscosity", o.air_viscosity)
       << attribute("gravity", Eigen::Vector3d(0.0, 0.0, -kGravity))
       << "/><worldbody><body><joint name=\"belt\" type=\"slide\" axis=\"0 1 0\"/>"
       << inertial(kBeltMass, o.pivot_f, Eigen::Matrix3d::Identity()) << "<body"
       << attribute("pos", Eigen::Vector3d(o.pivot_f - pivot_o)) << ">" << hookHingesXml(o.hook, 0)
       << hookAirXml() << "</body></body></worldbody></mujoco>";
  return text.str();
}

/// Belt where and as fast as it has to be, and driven so that it keeps to its profile.
void driveBelt(const HookWorldOptions& o, double time, mjData& data) {
  const double h = o.physics_step;
  data.qpos[0] = beltTravel(o.belt, time);
  data.qvel[0] = beltSpeed(o.belt, time);
  data.qfrc_applied[0] = kBeltMass * (beltSpeed(o.belt, time + h) - data.qvel[0]) / h;
}

HookWorldSample sampleOf(const HookWorldOptions& o, double time, const mjData& data) {
  HookWorldSample sample;
  sample.time_s = time;
  sample.angle[0] = data.qpos[1];
  sample.angle[1] = data.qpos[2];
  sample.pivot_f = o.pivot_f + Eigen::Vector3d(0.0, data.qpos[0], 0.0);
  sample.fMo.linear() = (Eigen::AngleAxisd(data.qpos[1], Eigen::Vector3d::UnitX()) *
                         Eigen::AngleAxisd(data.qpos[2], Eigen::Vector3d::UnitY()))
                            .toRotationMatrix();
  sample.fMo.translation() = sample.pivot_f - sample.fMo.linear() * hookPivot(o.hook.pivot_height);
  return sample;
}

}  // namespace

std::vector<HookWorldSample> simulateHookWorld(const HookWorldOptions& options, double duration_s,
                                               double sample_s) {
  const ModelPtr model = loadModel(hookWorldXml(options));
  const DataPtr data = makeData(*model);
  for (int axis = 0; axis < 2; ++axis) {
    data->qpos[1 + axis] = options.hook.angle[axis];
    data->qvel[1 + axis] = options.hook.rate[axis];
  }
  const double h = options.physics_step;
  const long every = std::max(1L, std::lround(sample_s / h));
  const long steps = std::lround(duration_s / h);
  std::vector<HookWorldSample> samples;
  std::size_t blow = 0;
  for (long i = 0; i <= steps; ++i) {
    const double time = static_cast<double>(i) * h;
    driveBelt(options, time, *data);
    for (; blow < options.blows.size() && options.blows[blow].time_s <= time; ++blow) {
      data->qvel[1] += options.blows[blow].rate_change[0];
      data->qvel[2] += options.blows[blow].rate_change[1];
    }
    if (i % every == 0) {
      samples.push_back(sampleOf(options, time, *data));
    }
    mj_step(model.get(), data.get());
  }
  checkHealth(*data);
  return samples;
}

}  // namespace ringhook
