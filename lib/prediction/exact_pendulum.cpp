#include "prediction/exact_pendulum.h"

#include <cassert>
#include <cmath>

namespace ringhook {
namespace {

/// e^(-d t) C and e^(-d t) S of the header.
struct Swing {
  double cosine;
  double sine;  // [s]
};

Swing swingOf(const PendulumRates& rates, double t) {
  const double d = 0.5 * rates.damping;
  const double n = rates.stiffness - d * d;
  const double x = n * t * t;
  if (std::abs(x) < 1e-6) {  // both series, as far as they matter in double
    const double decay = std::exp(-d * t);
    return {decay * (1.0 - x / 2.0 + x * x / 24.0), decay * t * (1.0 - x / 6.0 + x * x / 120.0)};
  }
  const double w = std::sqrt(std::abs(n));
  if (n > 0.0) {
    const double decay = std::exp(-d * t);
    return {decay * std::cos(w * t), decay * std::sin(w * t) / w};
  }
  const double slow = std::exp(-(d - w) * t);  // w < d: neither overflows
  const double quick = std::exp(-(d + w) * t);
  return {0.5 * (slow + quick), 0.5 * (slow - quick) / w};
}

}  // namespace

PendulumRates pendulumRates(double length_m, double damping_per_s, double gravity) {
  assert(length_m > 0.0);
  return {gravity / length_m, damping_per_s};
}

Eigen::Matrix2d exactPendulumTransition(const PendulumRates& rates, double dt) {
  const auto [C, S] = swingOf(rates, dt);
  const double d = 0.5 * rates.damping;
  Eigen::Matrix2d A;
  A << C + d * S, S, -rates.stiffness * S, C - d * S;
  return A;
}

Eigen::Matrix4d exactDriftingTransition(const PendulumRates& rates, double dt) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Identity();
  A(0, 1) = dt;
  A.bottomRightCorner<2, 2>() = exactPendulumTransition(rates, dt);
  return A;
}

Matrix5 exactTravellingTransition(const PendulumRates& rates, double dt) {
  Matrix5 A = Matrix5::Identity();
  A(0, 1) = A(1, 2) = dt;
  A(0, 2) = 0.5 * dt * dt;
  const Eigen::Matrix2d swing = exactPendulumTransition(rates, dt);
  A.bottomRightCorner<2, 2>() = swing;
  // s + a/k swings freely.
  A(3, 2) = (swing(0, 0) - 1.0) / rates.stiffness;
  A(4, 2) = swing(1, 0) / rates.stiffness;
  return A;
}

Eigen::Matrix2d pendulumDrift(const PendulumRates& rates) {
  Eigen::Matrix2d F;
  F << 0.0, 1.0, -rates.stiffness, -rates.damping;
  return F;
}

Eigen::Matrix4d driftingDrift(const PendulumRates& rates) {
  Eigen::Matrix4d F = Eigen::Matrix4d::Zero();
  F(0, 1) = 1.0;
  F.bottomRightCorner<2, 2>() = pendulumDrift(rates);
  return F;
}

Matrix5 travellingDrift(const PendulumRates& rates) {
  Matrix5 F = Matrix5::Zero();
  F(0, 1) = F(1, 2) = 1.0;
  F.bottomRightCorner<2, 2>() = pendulumDrift(rates);
  F(4, 2) = -1.0;
  return F;
}

Eigen::Matrix2d pendulumDensity(double swing_density) {
  return Eigen::Vector2d(0.0, swing_density).asDiagonal();
}

Eigen::Matrix4d driftingDensity(double pivot_density, double swing_density) {
  Eigen::Matrix4d W =
      Eigen::Vector4d(0.0, pivot_density, 0.0, swing_density + pivot_density).asDiagonal();
  W(1, 3) = W(3, 1) = -pivot_density;
  return W;
}

Matrix5 travellingDensity(double pivot_density, double swing_density) {
  Matrix5 W = Matrix5::Zero();
  W(2, 2) = pivot_density;
  W(4, 4) = swing_density;
  return W;
}

}  // namespace ringhook
