#include "swing_trial.h"

#include <cmath>

#include "sim/cell_options.h"
#include "sim/hook_body.h"

namespace ringhook {

SwingVector anyState() {
  SwingVector state = SwingVector::Zero();
  state.segment<9>(kSwingPivot) << 0.4, -0.5, 1.0, 0.01, 0.2, -0.02, 0.3, -0.8, 0.5;
  state.segment<4>(kSwingAngle) << 0.4, -0.3, 1.3, -0.9;
  state(kSwingLogLength) = std::log(0.35);
  state.segment<7>(kSwingLengthRatio) << 0.05, 0.04, 0.02, 0.1, 0.01, -0.02, 0.3;
  return state;
}

HookWorldOptions usualHook() {
  const HookOptions nominal;
  HookWorldOptions world;
  world.hook.friction = nominal.pivot_friction;
  world.hook.damping = nominal.pivot_damping;
  world.hook.angle[0] = 0.0873;
  world.hook.rate[1] = 0.4;
  world.belt.initial_speed = 0.2;
  return world;
}

HookFilterOptions usualKnowledge() {
  HookFilterOptions options;
  options.pivot_o = hookPivot(0.45);
  options.pendulum_length_m = 0.356;
  return options;
}

std::vector<SwingMeasurement> seenPoses(const std::vector<HookWorldSample>& truth, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Twist sigma;
  sigma << Eigen::Vector3d::Constant(2e-4), Eigen::Vector3d::Constant(1e-3);
  std::vector<SwingMeasurement> seen;
  for (const HookWorldSample& sample : truth) {
    const Twist off = sigma.cwiseProduct(Twist::NullaryExpr([&] { return normal(random); }));
    SwingMeasurement measurement;
    measurement.time = Time::fromSeconds(sample.time_s);
    measurement.fMo = sample.fMo * expSe3(off);
    measurement.covariance = Eigen::MatrixXd(sigma.cwiseAbs2().asDiagonal());
    seen.push_back(measurement);
  }
  return seen;
}

double missedAhead(SwingFilter& filter, const std::vector<SwingMeasurement>& seen,
                   const std::vector<HookWorldSample>& truth, std::size_t first, std::size_t end) {
  constexpr std::size_t kAhead = 15;  // frames
  double sum = 0.0;
  for (std::size_t i = 0; i < end; ++i) {
    (void)filter.update(seen[i]).hasValue();
    if (i >= first) {
      const SwingBelief then = predictSwing(*filter.state(), seen[i].time + kAhead * kTrialFrame);
      const Pose fMo = swingPose(then.mean, usualKnowledge().pivot_o);
      sum += (fMo.translation() - truth[i + kAhead].fMo.translation()).squaredNorm();
    }
  }
  return std::sqrt(sum / 3.0 / static_cast<double>(end - first));
}

}  // namespace ringhook
