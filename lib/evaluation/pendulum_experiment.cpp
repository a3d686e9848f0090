#include "evaluation/pendulum_experiment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/angle.h"
#include "evaluation/hanging_hook.h"
#include "evaluation/pendulum_theory.h"
#include "sim/hook_body.h"

namespace ringhook {
namespace {

constexpr double kReportStep = 0.05;    // [s]
constexpr double kReportDamping = 0.5;  // [1/s]
constexpr double kMinute = 60.0;        // [s]
constexpr double kTraced = 20.0;        // [s]
constexpr double kCompared = 10.0;      // [s]

using Samples = std::vector<PendulumSample>;

/// Every n-th sample, so that they stand `spacing` [s] apart, until `until_s`.
Samples thinned(const Samples& samples, double spacing, double until_s) {
  const double step = samples[1].time_s - samples[0].time_s;
  const auto stride = static_cast<std::size_t>(std::lround(spacing / step));
  Samples kept;
  for (std::size_t i = 0; i < samples.size(); i += stride) {
    if (samples[i].time_s <= until_s + 0.5 * step) {
      kept.push_back(samples[i]);
    }
  }
  return kept;
}

double largestDifference(const Samples& some, const Samples& reference) {
  double largest = 0.0;
  for (std::size_t i = 0; i < some.size() && some[i].time_s <= kCompared; ++i) {
    largest = std::max(largest, std::abs(some[i].angle - reference[i].angle));
  }
  return largest;
}

PendulumRow measuredRow(const std::string& name, const PendulumOptions& options,
                        const Samples& samples, const Samples& reference) {
  PendulumRow row;
  row.name = name;
  row.period = measuredPeriod(samples);
  row.energy_change =
      pendulumEnergy(options, samples.back()) / pendulumEnergy(options, samples.front()) - 1.0;
  row.angle_error = largestDifference(thinned(samples, kReportStep, kTraced), reference);
  return row;
}

/// What the report's map keeps if D is 0, in place of an energy: with p the rate and w = g / L,
/// p^2 + w q^2 - dt w q p stays the same under p' = p - dt w q, q' = q + dt p'.
double mapEnergy(const PendulumOptions& options, const PendulumSample& s) {
  const double w = kGravity / options.length;
  return s.rate * s.rate + w * s.angle * s.angle - kReportStep * w * s.angle * s.rate;
}

PendulumRow mapRow(const PendulumOptions& options, const Samples& samples,
                   const Samples& reference) {
  PendulumRow row = measuredRow("the report's map, step 0.05 s", options, samples, reference);
  row.energy_change =
      mapEnergy(options, samples.back()) / mapEnergy(options, samples.front()) - 1.0;
  return row;
}

PendulumRow statement(const std::string& name, double period) {
  PendulumRow row;
  row.name = name;
  row.period = period;
  return row;
}

void addSimulated(PendulumCase& one, PendulumOptions options, const Samples& reference) {
  const std::pair<const char*, PendulumStepping> ways[] = {
      {"simulated as in the cell (leapfrog, 0.5 ms)", PendulumStepping::leapfrog},
      {"simulated, semi-implicit Euler, 0.5 ms", PendulumStepping::euler},
      {"simulated, Runge-Kutta 4, 0.5 ms", PendulumStepping::rk4}};
  for (const auto& [name, stepping] : ways) {
    options.stepping = stepping;
    one.rows.push_back(measuredRow(name, options, simulatePendulum(options, kMinute), reference));
  }
}

PendulumCase pointMass(double damping, std::vector<Samples>& traces) {
  PendulumOptions options;
  options.damping = damping;
  PendulumCase one;
  one.name = damping > 0.0 ? "point mass, 1 m, 1 kg, from 1 rad, D = 0.5"
                           : "point mass, 1 m, 1 kg, from 1 rad, D = 0";
  one.key = damping > 0.0 ? "damped" : "undamped";
  one.small_period = 2.0 * std::numbers::pi * std::sqrt(options.length / kGravity);
  one.exact_period = exactPeriod(one.small_period, options.start);
  const Samples reference = referencePendulum(options, kReportStep, kMinute);
  const Samples map = reportPendulum(options, kReportStep, kMinute);
  if (damping == 0.0) {
    one.rows.push_back(statement("the report's statement", 2.0));
    one.rows.push_back(statement("2 pi sqrt(L / g)", one.small_period));
    one.rows.push_back(statement("exact at 1 rad (elliptic integral)", one.exact_period));
  } else {
    one.rows.push_back(measuredRow("the equation, integrated finely", options, reference,
                                   thinned(reference, kReportStep, kTraced)));
  }
  one.rows.push_back(mapRow(options, map, reference));
  addSimulated(one, options, reference);
  traces = {thinned(reference, kReportStep, kTraced),
            thinned(simulatePendulum(options, kTraced), kReportStep, kTraced),
            thinned(map, kReportStep, kTraced)};
  return one;
}

/// The cell's hook in a vacuum, without friction.
PendulumCase hangingHook(double about_x, double about_y) {
  PendulumCase one;
  const bool both = about_y > 0.0;
  one.name = both ? "the cell's hook, 15 deg in both planes, vacuum, no friction"
                  : "the cell's hook, 8 deg along the belt, vacuum, no friction";
  one.key = both ? "hook_both_planes" : "hook_one_plane";
  one.small_period = 2.0 * std::numbers::pi / swingFrequency(HookShape{}.shank_length, 0);
  const HangingHookRun run = runHangingHook(hangingHookCell(about_x, about_y), kMinute);
  if (!both) {
    one.exact_period = exactPeriod(one.small_period, turningPoints(run.about_x).front());
    one.rows.push_back(statement("2 pi sqrt(I / (m g d))", one.small_period));
    one.rows.push_back(statement("exact at its amplitude (elliptic integral)", one.exact_period));
  }
  PendulumRow row = statement("simulated in the cell", measuredPeriod(run.about_x));
  row.energy_change = run.energy.back() / run.energy.front() - 1.0;
  one.rows.push_back(row);
  return one;
}

}  // namespace

PendulumExperiment runPendulumExperiment() {
  PendulumExperiment experiment;
  for (const double damping : {0.0, kReportDamping}) {
    std::vector<Samples> traces;
    experiment.cases.push_back(pointMass(damping, traces));
    experiment.traces.push_back(std::move(traces));
  }
  experiment.cases.push_back(hangingHook(8.0 * kDegree, 0.0));
  experiment.cases.push_back(hangingHook(15.0 * kDegree, 15.0 * kDegree));
  return experiment;
}

}  // namespace ringhook
