#include "prediction/swing_law.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "prediction/swing_walk.h"

namespace ringhook {
namespace {

constexpr double kLength = 0.35;  // [m]

/// At rest below a pivot at rest, nothing known to be unusual.
SwingVector hanging() {
  SwingVector state = SwingVector::Zero();
  state(kSwingLogLength) = std::log(kLength);
  return state;
}

SwingVector anyState() {
  SwingVector state = hanging();
  state.segment<9>(kSwingPivot) << 0.4, -0.5, 1.0, 0.01, 0.2, -0.02, 0.3, -0.8, 0.5;
  state.segment<4>(kSwingAngle) << 0.7, -0.5, 1.3, -0.9;
  state.segment<7>(kSwingLengthRatio) << 0.05, 0.04, 0.02, 0.1, 0.01, -0.02, 0.3;
  return state;
}

/// (angle, rate) of one plane after `seconds`, small steps.
SwingVector swung(SwingVector state, double seconds, const SwingLaw& law) {
  const int steps = static_cast<int>(std::ceil(seconds / 1e-3));
  for (int i = 0; i < steps; ++i) {
    state = walkSwing(state, seconds / steps, law);
  }
  return state;
}

double energy(const SwingVector& s, const SwingLaw& law) {
  const double a = s(kSwingAngle);
  const double b = s(kSwingAngle + 1);
  const double wa = s(kSwingRate) * std::cos(b);
  const double wb = s(kSwingRate + 1);
  return 0.5 * kLength * kLength * (wa * wa + wb * wb) -
         law.gravity * kLength * std::cos(a) * std::cos(b);
}

TEST(SwingLaw, ItsJacobianIsTheSlopesDerivative) {
  const SwingLaw law;
  for (const double rate : {1.3, 0.01}) {  // beyond and inside the dry friction's corner
    SwingVector state = anyState();
    state(kSwingRate) = rate;
    const SwingSlopeJacobian J = swingSlopeJacobian(state, law);
    for (int i = 0; i < kSwingStates; ++i) {
      constexpr double kStep = 1e-6;
      SwingVector above = state;
      SwingVector below = state;
      above(i) += kStep;
      below(i) -= kStep;
      const SwingSlope difference = (swingSlope(above, law) - swingSlope(below, law)) / (2 * kStep);
      EXPECT_LT((J.col(i) - difference).cwiseAbs().maxCoeff(), 1e-7) << "column " << i;
    }
  }
}

TEST(SwingLaw, OnePlaneIsThePlanePendulum) {
  const SwingLaw law;
  for (const int axis : {0, 1}) {
    SwingVector state = hanging();
    state(kSwingAngle + axis) = 1.1;
    const SwingSlope slope = swingSlope(state, law);
    EXPECT_NEAR(slope(kSwingRate + axis), -law.gravity / kLength * std::sin(1.1), 1e-12);
    EXPECT_NEAR(slope(kSwingRate + 1 - axis), 0.0, 1e-12);
  }
}

// T = 2 pi sqrt(L / g) / agm(1, cos(amplitude / 2)): Gauss' arithmetic-geometric mean.
TEST(SwingLaw, SwingsOneRadianInTheEllipticPeriod) {
  const SwingLaw law;
  double a = 1.0;
  double g = std::cos(0.5);
  for (int i = 0; i < 6; ++i) {
    const double mean = 0.5 * (a + g);
    g = std::sqrt(a * g);
    a = mean;
  }
  const double period = 2.0 * std::numbers::pi * std::sqrt(kLength / law.gravity) / a;
  for (const int axis : {0, 1}) {
    SwingVector state = hanging();
    state(kSwingAngle + axis) = 1.0;
    const SwingVector quarter = swung(state, 0.25 * period, law);
    EXPECT_NEAR(quarter(kSwingAngle + axis), 0.0, 1e-9);
    const SwingVector back = swung(state, period, law);
    EXPECT_NEAR(back(kSwingAngle + axis), 1.0, 1e-9);
    EXPECT_NEAR(back(kSwingRate + axis), 0.0, 1e-8);
  }
}

TEST(SwingLaw, KeepsItsEnergyWithoutFriction) {
  const SwingLaw law;
  SwingVector state = hanging();
  state.segment<4>(kSwingAngle) << 0.6, 0.4, 1.0, -2.0;
  const double before = energy(state, law);
  EXPECT_NEAR(energy(swung(state, 5.0, law), law), before, 1e-9);
  state(kSwingViscous) = 0.1;
  EXPECT_LT(energy(swung(state, 5.0, law), law), before - 0.01);
}

TEST(SwingLaw, FrictionSlowsWhateverTheDirection) {
  const SwingLaw law;
  for (const double rate : {-1.0, 1.0}) {
    SwingVector state = hanging();
    state(kSwingRate) = state(kSwingRate + 1) = rate;
    state(kSwingViscous) = 0.2;
    state(kSwingDry) = 0.1;
    const SwingSlope slope = swingSlope(state, law);
    EXPECT_NEAR(slope(kSwingRate), -0.3 * rate, 1e-9);
    EXPECT_NEAR(slope(kSwingRate + 1), -0.3 * rate, 1e-9);
  }
}

// The shank's direction u as a unit vector, no angles:
// u'' = -|u'|^2 u + (I - u u^T) G / L with the felt gravity G = -(A + (0, 0, g)).
using Direction = Eigen::Matrix<double, 6, 1>;

Direction directionSlope(const Direction& s, const Eigen::Vector3d& felt) {
  const Eigen::Vector3d u = s.head<3>();
  const Eigen::Vector3d w = s.tail<3>();
  Direction slope;
  slope << w, -w.squaredNorm() * u + (felt - u * u.dot(felt)) / kLength;
  return slope;
}

Eigen::Vector3d directionOf(const SwingVector& s) {
  const double a = s(kSwingAngle);
  const double b = s(kSwingAngle + 1);
  return {-std::sin(b), std::sin(a) * std::cos(b), -std::cos(a) * std::cos(b)};
}

TEST(SwingLaw, GoesWhereAUnitVectorGoesBelowAnAcceleratedPivot) {
  SwingLaw law;
  law.memory_s = 1e9;  // the acceleration stays
  SwingVector state = hanging();
  state.segment<3>(kSwingAcceleration) << 0.7, -1.2, 0.9;
  state.segment<4>(kSwingAngle) << 0.5, 0.3, -1.0, 2.0;
  const Eigen::Vector3d felt = -Eigen::Vector3d(0.7, -1.2, 0.9 + law.gravity);
  Direction s;
  s.head<3>() = directionOf(state);
  constexpr double kEps = 1e-7;
  SwingVector next = state;
  next.segment<2>(kSwingAngle) += kEps * state.segment<2>(kSwingRate);
  SwingVector last = state;
  last.segment<2>(kSwingAngle) -= kEps * state.segment<2>(kSwingRate);
  s.tail<3>() = (directionOf(next) - directionOf(last)) / (2.0 * kEps);
  constexpr double kStep = 5e-4;
  for (int i = 0; i < 4000; ++i) {
    const Direction k1 = directionSlope(s, felt);
    const Direction k2 = directionSlope(s + 0.5 * kStep * k1, felt);
    const Direction k3 = directionSlope(s + 0.5 * kStep * k2, felt);
    const Direction k4 = directionSlope(s + kStep * k3, felt);
    s += kStep / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  EXPECT_LT((directionOf(swung(state, 2.0, law)) - s.head<3>()).norm(), 1e-6);
}

TEST(SwingLaw, ThePivotsAccelerationForgetsItself) {
  SwingLaw law;
  law.memory_s = 0.4;
  SwingVector state = hanging();
  state(kSwingAcceleration + 1) = 2.0;
  const SwingVector later = swung(state, 0.6, law);
  const double left = std::exp(-0.6 / 0.4);
  EXPECT_NEAR(later(kSwingAcceleration + 1), 2.0 * left, 1e-9);
  EXPECT_NEAR(later(kSwingSpeed + 1), 2.0 * 0.4 * (1.0 - left), 1e-9);
  EXPECT_NEAR(later(kSwingPivot + 1), 2.0 * 0.4 * (0.6 - 0.4 * (1.0 - left)), 1e-9);
}

}  // namespace
}  // namespace ringhook
