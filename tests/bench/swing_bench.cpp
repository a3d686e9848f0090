/// \file
/// What the swing filter costs per measurement in steady state, update and prediction 0.3 s ahead,
/// for poses and for points; beside it the hook filter with the linear pendulum.

#include <benchmark/benchmark.h>

#include <cmath>

#include "prediction/hook_filter.h"
#include "prediction/hook_swing.h"

namespace ringhook {
namespace {

constexpr double kFrame = 0.02;  // [s]
constexpr double kAhead = 0.3;   // [s]

/// A hook of the default kind that swings by 5 degrees in x and 4 in y below a belt.
SwingVector hookAt(const HookFilterOptions& options, double t) {
  static const SwingVector hanging = swingOptions({}).prior.mean;
  SwingVector state = hanging;
  const double w = std::sqrt(options.gravity / options.pendulum_length_m);
  state.segment<3>(kSwingPivot) << 0.42, -0.5 + 0.2 * t, 1.05;
  state(kSwingSpeed + 1) = 0.2;
  state.segment<2>(kSwingAngle) << 0.087 * std::cos(w * t), 0.07 * std::sin(w * t);
  state.segment<2>(kSwingRate) << -0.087 * w * std::sin(w * t), 0.07 * w * std::cos(w * t);
  return state;
}

/// A tenth of a millimetre of noise that needs no generator.
Eigen::Vector3d noise(long k) {
  const auto x = static_cast<double>(k);
  return 1e-4 * Eigen::Vector3d(std::sin(12.9 * x), std::sin(78.2 * x), std::sin(37.7 * x));
}

SwingMeasurement seen(const HookFilterOptions& options, SwingSight sight, long k) {
  const double t = kFrame * static_cast<double>(k);
  SwingMeasurement m;
  m.time = Time::fromSeconds(t);
  m.sight = sight;
  m.fMo = swingPose(hookAt(options, t), options.pivot_o);
  m.fMo.translation() += noise(k);
  m.value = m.fMo.translation();
  const int size = swingSightSize(sight);
  m.covariance = SwingValueCovariance::Identity(size, size) * 4e-8;
  if (sight == SwingSight::kPose) {
    m.covariance.bottomRightCorner(3, 3).diagonal().setConstant(1e-6);
  }
  return m;
}

/// A belief as it is after three seconds, with what a filter step needs.
struct Steady {
  HookFilterOptions hook;
  SwingFilterOptions options = swingOptions(hook);
  SwingBelief belief;
  long k = 0;

  explicit Steady(SwingSight sight) {
    belief.mean = hookAt(hook, 0.0);
    belief.covariance = options.prior.covariance;
    for (; k < 150; ++k) {
      step(sight);
    }
  }
  void step(SwingSight sight) {
    const Time before = Time::fromSeconds(kFrame * static_cast<double>(k - 1));
    belief = swingStep(belief, before, seen(hook, sight, k), SwingMode::kSteady, options).belief;
  }
};

void update(benchmark::State& state, SwingSight sight) {
  const Steady start(sight);
  const SwingMeasurement measurement = seen(start.hook, sight, start.k);
  const Time before = measurement.time - kFrame;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        swingStep(start.belief, before, measurement, SwingMode::kSteady, start.options));
  }
}

void predict(benchmark::State& state, SwingSight sight) {
  const Steady start(sight);
  const SwingNoise quiet = swingNoise(start.options, SwingMode::kSteady);
  for (auto _ : state) {
    benchmark::DoNotOptimize(walkSwingBelief(start.belief, kAhead, start.options.law, quiet));
  }
}

/// Filter and prediction as the cell has them, events looked for and late fixes kept.
void hookFilter(benchmark::State& state, HookMotionModel model) {
  HookFilterOptions options;
  options.model = model;
  HookFilter filter(options);
  long k = 0;
  const auto fixAt = [&] {
    HookFix fix;
    const SwingMeasurement m = seen(options, SwingSight::kPose, k++);
    fix.time = m.time;
    fix.c1Mo = options.fMc1.inverse() * m.fMo;
    fix.covariance = m.covariance;
    return fix;
  };
  while (k < 250) {
    benchmark::DoNotOptimize(filter.update(fixAt()));
  }
  for (auto _ : state) {
    const HookFix fix = fixAt();
    benchmark::DoNotOptimize(filter.update(fix));
    benchmark::DoNotOptimize(filter.predict(fix.time + kAhead));
  }
}

BENCHMARK_CAPTURE(update, pose, SwingSight::kPose);
BENCHMARK_CAPTURE(update, point, SwingSight::kPoint);
BENCHMARK_CAPTURE(predict, pose, SwingSight::kPose);
BENCHMARK_CAPTURE(predict, point, SwingSight::kPoint);
BENCHMARK_CAPTURE(hookFilter, sphericalPendulum, HookMotionModel::kSphericalPendulum);
BENCHMARK_CAPTURE(hookFilter, linearPendulum, HookMotionModel::kPendulum);

}  // namespace
}  // namespace ringhook
