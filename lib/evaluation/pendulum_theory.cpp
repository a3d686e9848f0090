#include "evaluation/pendulum_theory.h"

#include <cmath>
#include <limits>
#include <optional>

#include "sim/hook_body.h"

namespace ringhook {
namespace {

constexpr double kReferenceStep = 1e-4;  // [s]

struct State {
  double angle;
  double rate;
};

State derivative(const PendulumOptions& o, const State& s) {
  return {s.rate, -o.damping * s.rate - kGravity / o.length * std::sin(s.angle)};
}

State moved(const State& s, const State& d, double h) {
  return {s.angle + h * d.angle, s.rate + h * d.rate};
}

State rungeKutta(const PendulumOptions& o, const State& s, double h) {
  const State k1 = derivative(o, s);
  const State k2 = derivative(o, moved(s, k1, 0.5 * h));
  const State k3 = derivative(o, moved(s, k2, 0.5 * h));
  const State k4 = derivative(o, moved(s, k3, h));
  return {s.angle + h / 6.0 * (k1.angle + 2.0 * k2.angle + 2.0 * k3.angle + k4.angle),
          s.rate + h / 6.0 * (k1.rate + 2.0 * k2.rate + 2.0 * k3.rate + k4.rate)};
}

/// Where in [0, 1] between two samples the cubic Hermite curve through them passes zero upwards.
std::optional<double> upwardCrossing(const PendulumSample& a, const PendulumSample& b) {
  if (!(a.angle < 0.0 && b.angle >= 0.0)) {
    return std::nullopt;
  }
  const double h = b.time_s - a.time_s;
  const auto curve = [&](double u) {
    const double w = 1.0 - u;
    return w * w * (1.0 + 2.0 * u) * a.angle + u * u * (3.0 - 2.0 * u) * b.angle +
           h * u * w * (w * a.rate - u * b.rate);
  };
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (curve(middle) < 0.0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

double exactPeriod(double small_period, double amplitude) {
  double a = 1.0;
  double b = std::cos(0.5 * amplitude);
  while (std::abs(a - b) > 1e-15 * a) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return small_period / a;
}

std::vector<PendulumSample> reportPendulum(const PendulumOptions& o, double dt, double duration_s) {
  double angle = o.start;
  double speed = 0.0;
  std::vector<PendulumSample> samples{{0.0, angle, 0.0}};
  const long count = std::lround(duration_s / dt);
  for (long i = 1; i <= count; ++i) {
    speed = (1.0 - o.damping / o.mass * dt) * speed - kGravity * dt * angle;
    angle += dt * speed / o.length;
    samples.push_back({static_cast<double>(i) * dt, angle, speed / o.length});
  }
  return samples;
}

std::vector<PendulumSample> referencePendulum(const PendulumOptions& o, double sample_s,
                                              double duration_s) {
  State state{o.start, 0.0};
  std::vector<PendulumSample> samples{{0.0, state.angle, state.rate}};
  const long inner = std::lround(sample_s / kReferenceStep);
  const long count = std::lround(duration_s / sample_s);
  for (long i = 1; i <= count; ++i) {
    for (long k = 0; k < inner; ++k) {
      state = rungeKutta(o, state, kReferenceStep);
    }
    samples.push_back({static_cast<double>(i) * sample_s, state.angle, state.rate});
  }
  return samples;
}

double measuredPeriod(const std::vector<PendulumSample>& samples) {
  std::optional<double> first;
  double last = 0.0;
  int periods = -1;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (const auto u = upwardCrossing(samples[i - 1], samples[i])) {
      last = samples[i - 1].time_s + *u * (samples[i].time_s - samples[i - 1].time_s);
      first = first.value_or(last);
      ++periods;
    }
  }
  return periods > 0 ? (last - *first) / periods : std::numeric_limits<double>::quiet_NaN();
}

double pendulumEnergy(const PendulumOptions& o, const PendulumSample& sample) {
  return 0.5 * sample.rate * sample.rate + kGravity / o.length * (1.0 - std::cos(sample.angle));
}

}  // namespace ringhook
