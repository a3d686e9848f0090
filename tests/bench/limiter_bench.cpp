/// \file
/// What the limiter costs per command: at the speeds of servoing, and where it has to search.

#include <benchmark/benchmark.h>

#include <cmath>

#include "robot/limiter.h"

namespace ringhook {
namespace {

JointVector middle() {
  JointVector q;
  q << 0.2, 0.3, 1.5, 0.1, -0.8, 0.3;
  return q;
}

/// Swings about the middle of the workspace with `amplitude` [rad/s] at 1.35 s, like a hook.
void swing(benchmark::State& state, double amplitude, const LimiterSettings& settings) {
  Limiter limiter(settings);
  JointVector q = middle();
  long k = 0;
  long bent = 0;
  for (auto _ : state) {
    const double wave = std::sin(4.654 * settings.period_s * static_cast<double>(k++));
    const LimitedVelocity out = limiter.limit(JointVector::Constant(amplitude * wave), q);
    q += settings.period_s * out.velocity;
    bent += out.limited() ? 1 : 0;
  }
  state.counters["bent"] =
      benchmark::Counter(static_cast<double>(bent), benchmark::Counter::kAvgIterations);
}

void BM_Servoing(benchmark::State& state) { swing(state, 0.3, {}); }
BENCHMARK(BM_Servoing);

void BM_ServoingInABox(benchmark::State& state) {
  LimiterSettings settings;
  settings.box.upper.x() = 2.0;
  swing(state, 0.3, settings);
}
BENCHMARK(BM_ServoingInABox);

void BM_FastMoves(benchmark::State& state) { swing(state, 1.5, {}); }
BENCHMARK(BM_FastMoves);

void BM_AlwaysTooFast(benchmark::State& state) { swing(state, 20.0, {}); }
BENCHMARK(BM_AlwaysTooFast);

}  // namespace
}  // namespace ringhook
