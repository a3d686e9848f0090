#include "prediction/swing_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ringhook {
namespace {

constexpr int kConstants = kSwingStates - kSwingMoving;
constexpr int kSources = 5;  // pivot acceleration in three axes, swing acceleration in two

using Moving = Eigen::Matrix<double, kSwingMoving, 1>;
using MovingSquare = Eigen::Matrix<double, kSwingMoving, kSwingMoving>;
using MovingRows = SwingSlopeJacobian;  // 13 x 21
using Sources = Eigen::Matrix<double, kSwingMoving, kSources>;

// F * X for the sparse F of the law: all rows but the two of the swing's accelerations are copies.
template <class X>
void slopeOf(const SwingSlopeJacobian& F, const X& x, X& out) {
  out.template middleRows<3>(kSwingPivot) = x.template middleRows<3>(kSwingSpeed);
  out.template middleRows<3>(kSwingSpeed) = x.template middleRows<3>(kSwingAcceleration);
  out.template middleRows<3>(kSwingAcceleration) =
      F(kSwingAcceleration, kSwingAcceleration) * x.template middleRows<3>(kSwingAcceleration);
  out.template middleRows<2>(kSwingAngle) = x.template middleRows<2>(kSwingRate);
  for (int axis = 0; axis < 2; ++axis) {
    const int row = kSwingRate + axis;
    out.row(row) = F(row, kSwingAcceleration) * x.row(kSwingAcceleration);
    for (int j = kSwingAcceleration + 1; j < kSwingMoving; ++j) {
      out.row(row) += F(row, j) * x.row(j);
    }
  }
}

// d(F X)/d constants: the columns of the constants have F's own entries besides.
void slopeOfTransition(const SwingSlopeJacobian& F, const MovingRows& Phi, MovingRows& out) {
  slopeOf(F, Phi, out);
  out.block<2, kConstants>(kSwingRate, kSwingMoving) +=
      F.block<2, kConstants>(kSwingRate, kSwingMoving);
}

SwingVector moved(const SwingVector& state, double h, const SwingSlope& slope) {
  SwingVector next = state;
  next.head<kSwingMoving>() += h * slope;
  return next;
}

SwingVector step(const SwingVector& s, double h, const SwingLaw& law) {
  const SwingSlope k1 = swingSlope(s, law);
  const SwingSlope k2 = swingSlope(moved(s, 0.5 * h, k1), law);
  const SwingSlope k3 = swingSlope(moved(s, 0.5 * h, k2), law);
  const SwingSlope k4 = swingSlope(moved(s, h, k3), law);
  return moved(s, h / 6.0, k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

/// A step with the transition of its moving rows, and F in the step's middle.
struct Step {
  SwingVector state;
  MovingRows Phi;
  SwingSlopeJacobian F;
};

Step stepWithTransition(const SwingVector& s, double h, const SwingLaw& law) {
  const MovingRows I = MovingRows::Identity();
  Step result;
  const SwingSlope k1 = swingSlope(s, law);
  MovingRows K1 = swingSlopeJacobian(s, law);
  const SwingVector s2 = moved(s, 0.5 * h, k1);
  const SwingSlope k2 = swingSlope(s2, law);
  MovingRows K2;
  slopeOfTransition(swingSlopeJacobian(s2, law), I + 0.5 * h * K1, K2);
  const SwingVector s3 = moved(s, 0.5 * h, k2);
  const SwingSlope k3 = swingSlope(s3, law);
  result.F = swingSlopeJacobian(s3, law);
  MovingRows K3;
  slopeOfTransition(result.F, I + 0.5 * h * K2, K3);
  const SwingVector s4 = moved(s, h, k3);
  MovingRows K4;
  slopeOfTransition(swingSlopeJacobian(s4, law), I + h * K3, K4);
  result.state = moved(s, h / 6.0, k1 + 2.0 * k2 + 2.0 * k3 + swingSlope(s4, law));
  result.Phi = I + h / 6.0 * (K1 + 2.0 * K2 + 2.0 * K3 + K4);
  return result;
}

// exp(F s) G by its series; s is below 0.2 / w, so four terms leave less than 1e-5.
Sources spread(const SwingSlopeJacobian& F, const Sources& G, double s) {
  Sources sum = G;
  Sources term = G;
  for (int order = 1; order <= 4; ++order) {
    Sources next;
    slopeOf(F, term, next);
    term = next * (s / order);
    sum += term;
  }
  return sum;
}

// Van Loan's integral over |h|.
MovingSquare gatheredNoise(const SwingSlopeJacobian& F, double h, const SwingLaw& law,
                           const SwingNoise& noise) {
  Sources G = Sources::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    G(kSwingAcceleration + axis, axis) =
        noise.pivot_acceleration(axis) * std::sqrt(2.0 / law.memory_s);
  }
  G(kSwingRate, 3) = G(kSwingRate + 1, 4) = std::sqrt(noise.swing_density);
  constexpr std::array<double, 3> kNode = {0.5 - 0.3872983346207417, 0.5, 0.5 + 0.3872983346207417};
  constexpr std::array<double, 3> kWeight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  MovingSquare Q = MovingSquare::Zero();
  for (int i = 0; i < 3; ++i) {
    const Sources E = spread(F, G, kNode[i] * h);
    Q.noalias() += kWeight[i] * std::abs(h) * E.lazyProduct(E.transpose());
  }
  return Q;
}

int stepCount(const SwingVector& state, double dt, const SwingLaw& law) {
  return std::max(1, static_cast<int>(std::ceil(std::abs(dt) / longestSwingStep(state, law))));
}

void addWalks(double dt, const SwingNoise& noise, SwingMatrix& P) {
  const double t = std::abs(dt);
  P(kSwingLogLength, kSwingLogLength) += noise.length_density * t;
  P(kSwingViscous, kSwingViscous) += noise.damping_density * t;
  P(kSwingDry, kSwingDry) += noise.dry_density * t;
  P(kSwingLonger, kSwingLonger) += noise.longer_density * t;
  P(kSwingRest, kSwingRest) += noise.rest_density * t;
  P(kSwingRest + 1, kSwingRest + 1) += noise.rest_density * t;
  P(kSwingYaw, kSwingYaw) += noise.yaw_density * t;
}

// rows <- step after rows: the moving rows of Phi_step * [rows; 0 I].
void chain(const MovingRows& step, MovingRows& rows) {
  MovingRows next = step.leftCols<kSwingMoving>().lazyProduct(rows);
  next.rightCols<kConstants>() += step.rightCols<kConstants>();
  rows = next;
}

SwingMatrix whole(const MovingRows& rows) {
  SwingMatrix Phi = SwingMatrix::Identity();
  Phi.topRows<kSwingMoving>() = rows;
  return Phi;
}

}  // namespace

double longestSwingStep(const SwingVector& state, const SwingLaw& law) {
  const double length = std::exp(state(kSwingLogLength) + std::min(0.0, state(kSwingLengthRatio)));
  return 0.2 * std::sqrt(length / law.gravity);
}

SwingVector walkSwing(const SwingVector& state, double dt, const SwingLaw& law) {
  const int steps = stepCount(state, dt, law);
  SwingVector s = state;
  for (int i = 0; i < steps; ++i) {
    s = step(s, dt / steps, law);
  }
  return s;
}

SwingTransition walkSwingWithTransition(const SwingVector& state, double dt, const SwingLaw& law) {
  const int steps = stepCount(state, dt, law);
  SwingVector s = state;
  MovingRows rows = MovingRows::Identity();
  for (int i = 0; i < steps; ++i) {
    const Step one = stepWithTransition(s, dt / steps, law);
    s = one.state;
    chain(one.Phi, rows);
  }
  return {s, whole(rows)};
}

SwingBeliefWalk walkSwingBeliefWithTransition(const SwingBelief& belief, double dt,
                                              const SwingLaw& law, const SwingNoise& noise) {
  const int steps = stepCount(belief.mean, dt, law);
  const double h = dt / steps;
  SwingBeliefWalk result;
  result.belief.mean = belief.mean;
  MovingRows rows = MovingRows::Identity();
  MovingSquare Q = MovingSquare::Zero();
  for (int i = 0; i < steps; ++i) {
    const Step one = stepWithTransition(result.belief.mean, h, law);
    const MovingSquare A = one.Phi.leftCols<kSwingMoving>();
    result.belief.mean = one.state;
    chain(one.Phi, rows);
    if (i > 0) {
      Q = carried(A, Q);
    }
    Q += gatheredNoise(one.F, h, law, noise);
  }
  result.Phi = whole(rows);
  SwingMatrix P = carried(result.Phi, belief.covariance);
  P.topLeftCorner<kSwingMoving, kSwingMoving>() += Q;
  addWalks(dt, noise, P);
  result.belief.covariance = 0.5 * (P + P.transpose());
  return result;
}

SwingBelief walkSwingBelief(const SwingBelief& belief, double dt, const SwingLaw& law,
                            const SwingNoise& noise) {
  return walkSwingBeliefWithTransition(belief, dt, law, noise).belief;
}

}  // namespace ringhook
