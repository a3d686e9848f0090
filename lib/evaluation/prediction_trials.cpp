#include "evaluation/prediction_trials.h"

#include <cmath>
#include <numbers>

#include "core/angle.h"
#include "sim/cell_options.h"
#include "sim/hook_body.h"

namespace ringhook {
namespace {

constexpr double kTick = 0.001;  // [s]; of the truth

const HookWorldSample& sampleAt(const std::vector<HookWorldSample>& truth, double time_s) {
  return truth.at(static_cast<std::size_t>(std::lround(time_s / kTick)));
}

HookDraw drawHook(const TrialOptions& options, std::mt19937& random) {
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  const HookOptions nominal;
  HookDraw hook;
  hook.pivot_height = 0.45 * (1.0 + options.length_spread * even(random));
  hook.friction = nominal.pivot_friction * (1.0 + nominal.damping_spread * even(random));
  hook.damping = nominal.pivot_damping * (1.0 + nominal.damping_spread * even(random));
  const double amplitude = options.swing_deg * kDegree;
  for (int axis = 0; axis < 2; ++axis) {
    const double phase = std::numbers::pi * even(random);
    hook.angle[axis] = amplitude * std::cos(phase);
    hook.rate[axis] = -amplitude * swingFrequency(hook.pivot_height, axis) * std::sin(phase);
  }
  return hook;
}

}  // namespace

Eigen::Vector3d Trial::point(double time_s) const { return pose(time_s).translation(); }

const Pose& Trial::pose(double time_s) const { return sampleAt(truth, time_s).fMo; }

Eigen::Vector3d Trial::seenPoint(double time_s) {
  std::normal_distribution<double> noise(0.0, kTrialPositionSigma);
  return point(time_s) + Eigen::Vector3d::NullaryExpr([&] { return noise(random); });
}

HookFix Trial::seenPose(double time_s) {
  std::normal_distribution<double> noise;
  Twist sigma;
  sigma << Eigen::Vector3d::Constant(kTrialPositionSigma),
      Eigen::Vector3d::Constant(kTrialRotationSigma);
  const Twist off = sigma.cwiseProduct(Twist::NullaryExpr([&] { return noise(random); }));
  HookFix fix;
  fix.time = Time::fromSeconds(time_s);
  fix.c1Mo = sampleAt(truth, time_s).fMo * expSe3(off);
  fix.covariance = sigma.cwiseAbs2().asDiagonal();
  return fix;
}

int trialFrame(double time_s) { return static_cast<int>(std::lround(time_s / kTrialFrame)); }

HookFilterOptions trialHookOptions() {
  HookFilterOptions options;
  options.pivot_o = hookPivot(0.45);
  options.pendulum_length_m = 0.356;
  options.position_floor_m = options.rotation_floor_rad = 0.0;  // fixes say all of their noise
  return options;
}

void followTrial(HookFilter& filter, Trial& trial, double from_s, double until_s) {
  for (int i = trialFrame(from_s); i <= trialFrame(until_s); ++i) {
    (void)filter.update(trial.seenPose(i * kTrialFrame)).hasValue();
  }
}

Trial makeTrial(const TrialOptions& options, unsigned seed) {
  Trial trial;
  trial.random.seed(seed);
  HookWorldOptions world;
  world.hook = drawHook(options, trial.random);
  world.belt.initial_speed = options.belt_speed;
  if (options.stop_at_s > 0.0) {
    world.belt.changes = {{options.stop_at_s, 0.0}};
  }
  trial.truth = simulateHookWorld(world, options.duration_s, kTick);
  return trial;
}

}  // namespace ringhook
