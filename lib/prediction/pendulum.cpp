#include "prediction/pendulum.h"

#include <Eigen/LU>
#include <cassert>
#include <cmath>

#include "prediction/chi_square.h"

namespace ringhook {
namespace {

// White noise on phi'' over one short step, on (phi, L phi').
Eigen::Matrix2d stepNoise(double length, double dt, double density) {
  Eigen::Matrix2d Q;
  Q << dt * dt * dt / 3, length * dt * dt / 2, length * dt * dt / 2, length * length * dt;
  return density * Q;
}

void walkStep(const PendulumParameters& parameters, double dt, double density, PendulumWalk& walk) {
  const Eigen::Matrix2d A = pendulumMap(parameters, dt);
  walk.transition = A * walk.transition;
  walk.noise = A * walk.noise * A.transpose() + stepNoise(parameters.length_m, dt, density);
}

}  // namespace

Eigen::Matrix2d pendulumMap(const PendulumParameters& parameters, double dt) {
  const double L = parameters.length_m;
  const double g = parameters.gravity;
  const double keep = 1.0 - parameters.damping_kg_per_s * dt / parameters.mass_kg;
  Eigen::Matrix2d A;
  A << 1.0 - g * dt * dt / L, keep * dt / L, -g * dt, keep;
  return A;
}

PendulumWalk walkPendulum(const PendulumParameters& parameters, double duration,
                          double acceleration_density) {
  assert(parameters.step_s > 0.0);
  PendulumWalk walk{Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Zero()};
  const double length = std::abs(duration);
  const double whole = std::floor(length / parameters.step_s);
  for (double i = 0.0; i < whole; i += 1.0) {
    walkStep(parameters, parameters.step_s, acceleration_density, walk);
  }
  walkStep(parameters, length - whole * parameters.step_s, acceleration_density, walk);
  if (duration < 0.0) {
    const Eigen::Matrix2d back = walk.transition.inverse();
    walk = {back, back * walk.noise * back.transpose()};
  }
  return walk;
}

double mapFrequency(const PendulumParameters& parameters) {
  const double dt = parameters.step_s;
  return std::acos(1.0 - parameters.gravity * dt * dt / (2.0 * parameters.length_m)) / dt;
}

std::vector<Eigen::Vector2d> simulatePendulum(const PendulumParameters& parameters, PendulumLaw law,
                                              double phi0, int steps) {
  const double dt = parameters.step_s;
  const double keep = 1.0 - parameters.damping_kg_per_s * dt / parameters.mass_kg;
  std::vector<Eigen::Vector2d> states{Eigen::Vector2d(phi0, 0.0)};
  for (int i = 0; i < steps; ++i) {
    const double phi = states.back().x();
    const double pull = law == PendulumLaw::kLinear ? phi : std::sin(phi);
    const double v = keep * states.back().y() - parameters.gravity * dt * pull;  // 5.18
    states.emplace_back(phi + v * dt / parameters.length_m, v);                  // 5.19
  }
  return states;
}

PendulumFilter::PendulumFilter(const PendulumFilterOptions& options) : options_(options) {
  if (options.gate_probability > 0.0) {
    gate_ = chiSquareQuantile(options.gate_probability, 1.0);
  }
}

Gaussian<2> PendulumFilter::ahead(Time time) const {
  const PendulumWalk walk =
      walkPendulum(options_.pendulum, time - *time_, options_.acceleration_density);
  return kalmanPredict<2>(belief_, walk.transition, walk.noise);
}

Outcome<FilterUpdate> PendulumFilter::update(Time time, double angle, double variance) {
  using Scalar1 = Eigen::Matrix<double, 1, 1>;
  if (!std::isfinite(angle) || !(variance > 0.0) || !std::isfinite(variance)) {
    return Refusal{"not finite"};
  }
  if (!time_) {
    const double v_sigma = options_.pendulum.length_m * options_.rate_sigma;
    belief_.mean << angle, 0.0;
    belief_.covariance << variance, 0.0, 0.0, v_sigma * v_sigma;
    time_ = time;
    return FilterUpdate{time, 0.0, 1};
  }
  if (time <= *time_) {
    return Refusal{"late or duplicate time stamp"};
  }
  const auto correction = kalmanCorrect<2, 1>(ahead(time), Scalar1(angle),
                                              Eigen::RowVector2d(1.0, 0.0), Scalar1(variance));
  if (gate_ > 0.0 && !(correction.nis <= gate_)) {
    return Refusal{"outside the gate"};
  }
  belief_ = correction.belief;
  time_ = time;
  return FilterUpdate{time, correction.nis, 1};
}

Outcome<Gaussian<2>> PendulumFilter::predict(Time time) const {
  if (!time_) {
    return Refusal{"no measurement yet"};
  }
  return ahead(time);
}

}  // namespace ringhook
