#include "prediction/swing_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ringhook {
namespace {

constexpr int kSources = 5;  // pivot acceleration in three axes, swing acceleration in two
constexpr int kCauses = 11;  // of the swing: the pivot's acceleration, angles, rates, L to friction

static_assert(kSwingAngle == kSwingAcceleration + 3 && kSwingRate == kSwingAngle + 2 &&
              kSwingLogLength == kSwingRate + 2 && kSwingDry == kSwingLogLength + 3);

using SwingRows = Eigen::Matrix<double, 4, kCauses>;  // of angles and rates, by their causes
using MovingSquare = Eigen::Matrix<double, kSwingMoving, kSwingMoving>;

/// A transition without its many zeros and ones: the chain A -> v -> p is the same in three axes,
/// and the swing knows of nothing but its causes, which stand in a row in the state.
struct Transition {
  Eigen::Matrix3d chain = Eigen::Matrix3d::Identity();  ///< of (p, v, A), upper triangular
  SwingRows swing = atRest();

  static SwingRows atRest() {
    SwingRows rows = SwingRows::Zero();
    rows.middleCols<4>(3).setIdentity();
    return rows;
  }
};

/// Rows of the law's F that are no copies.
SwingRows swingRowsOf(const SwingSlopeJacobian& F) {
  SwingRows rows = SwingRows::Zero();
  rows(0, 5) = rows(1, 6) = 1.0;
  rows.bottomRows<2>() = F.block<2, kCauses>(kSwingRate, kSwingAcceleration);
  return rows;
}

/// second * first: what `first` did and then `second`, of which the constants stay in place.
SwingRows after(const SwingRows& second, const SwingRows& first, double acceleration) {
  SwingRows rows = second.middleCols<4>(3).lazyProduct(first);
  rows.leftCols<3>() += acceleration * second.leftCols<3>();
  rows.rightCols<4>() += second.rightCols<4>();
  return rows;
}

/// Phi * X.
SwingMatrix applied(const Transition& T, const SwingMatrix& X) {
  SwingMatrix Y = X;
  const auto v = X.middleRows<3>(kSwingSpeed);
  const auto A = X.middleRows<3>(kSwingAcceleration);
  Y.middleRows<3>(kSwingPivot) += T.chain(0, 1) * v + T.chain(0, 2) * A;
  Y.middleRows<3>(kSwingSpeed) += T.chain(1, 2) * A;
  Y.middleRows<3>(kSwingAcceleration) = T.chain(2, 2) * A;
  Y.middleRows<4>(kSwingAngle) = T.swing.lazyProduct(X.middleRows<kCauses>(kSwingAcceleration));
  return Y;
}

SwingMatrix whole(const Transition& T) { return applied(T, SwingMatrix::Identity()); }

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

/// A step with its transition, and F in the step's middle.
struct Step {
  SwingVector state;
  Transition transition;
  SwingSlopeJacobian F;
};

/// Transition of a Runge-Kutta step whose four stages have these F.
Transition rungeKutta(const SwingRows (&F)[4], double h, double memory_s) {
  Eigen::Matrix3d drift = Eigen::Matrix3d::Zero();
  drift(0, 1) = drift(1, 2) = 1.0;
  drift(2, 2) = -1.0 / memory_s;
  const double part[] = {0.0, 0.5 * h, 0.5 * h, h};
  const double weight[] = {h / 6.0, h / 3.0, h / 3.0, h / 6.0};
  Transition result;
  Eigen::Matrix3d chain_slope = Eigen::Matrix3d::Zero();
  SwingRows swing_slope = SwingRows::Zero();
  for (int stage = 0; stage < 4; ++stage) {
    const Eigen::Matrix3d chain = Eigen::Matrix3d::Identity() + part[stage] * chain_slope;
    const SwingRows swing = Transition::atRest() + part[stage] * swing_slope;
    swing_slope = after(F[stage], swing, chain(2, 2));
    chain_slope = drift.lazyProduct(chain);
    result.chain += weight[stage] * chain_slope;
    result.swing += weight[stage] * swing_slope;
  }
  return result;
}

Step stepWithTransition(const SwingVector& s, double h, const SwingLaw& law) {
  const SwingSlope k1 = swingSlope(s, law);
  const SwingVector s2 = moved(s, 0.5 * h, k1);
  const SwingSlope k2 = swingSlope(s2, law);
  const SwingVector s3 = moved(s, 0.5 * h, k2);
  const SwingSlope k3 = swingSlope(s3, law);
  const SwingVector s4 = moved(s, h, k3);
  Step result;
  result.F = swingSlopeJacobian(s3, law);
  const SwingRows F[] = {swingRowsOf(swingSlopeJacobian(s, law)),
                         swingRowsOf(swingSlopeJacobian(s2, law)), swingRowsOf(result.F),
                         swingRowsOf(swingSlopeJacobian(s4, law))};
  result.state = moved(s, h / 6.0, k1 + 2.0 * k2 + 2.0 * k3 + swingSlope(s4, law));
  result.transition = rungeKutta(F, h, law.memory_s);
  return result;
}

/// exp(F s) of a source's place: along the chain, the same in three axes, and in the swing.
struct Spread {
  Eigen::Vector3d chain;
  Eigen::Matrix<double, 4, kSources> swing;
};

// By its series; s is below 0.2 / w, so four terms leave less than 1e-5.
Spread spread(const SwingSlopeJacobian& F, double s) {
  const auto pull = F.block<2, 3>(kSwingRate, kSwingAcceleration);
  const auto own = F.block<2, 4>(kSwingRate, kSwingAngle);
  Spread term;
  term.chain = Eigen::Vector3d::UnitZ();
  term.swing.setZero();
  term.swing.bottomRightCorner<2, 2>().setIdentity();
  Spread sum = term;
  for (int order = 1; order <= 4; ++order) {
    const double part = s / order;
    Spread next;
    next.chain << term.chain(1), term.chain(2),
        F(kSwingAcceleration, kSwingAcceleration) * term.chain(2);
    next.swing.topRows<2>() = term.swing.bottomRows<2>();
    next.swing.bottomRows<2>() = own.lazyProduct(term.swing);
    next.swing.bottomLeftCorner<2, 3>() += term.chain(2) * pull;
    term.chain = part * next.chain;
    term.swing = part * next.swing;
    sum.chain += term.chain;
    sum.swing += term.swing;
  }
  return sum;
}

// Van Loan's integral over |h|, added to P.
void addGathered(const SwingSlopeJacobian& F, double h, const SwingLaw& law,
                 const SwingNoise& noise, SwingMatrix& P) {
  Eigen::Matrix<double, kSources, 1> density;
  density << noise.pivot_acceleration.cwiseAbs2() * (2.0 / law.memory_s),
      Eigen::Vector2d::Constant(noise.swing_density);
  constexpr std::array<double, 3> kNode = {0.5 - 0.3872983346207417, 0.5, 0.5 + 0.3872983346207417};
  constexpr std::array<double, 3> kWeight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  for (std::size_t i = 0; i < kNode.size(); ++i) {
    const Spread E = spread(F, kNode[i] * h);
    Eigen::Matrix<double, kSwingMoving, kSources> all =
        Eigen::Matrix<double, kSwingMoving, kSources>::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      all(kSwingPivot + axis, axis) = E.chain(0);
      all(kSwingSpeed + axis, axis) = E.chain(1);
      all(kSwingAcceleration + axis, axis) = E.chain(2);
    }
    all.bottomRows<4>() = E.swing;
    const Eigen::Matrix<double, kSwingMoving, kSources> weighted =
        all * (kWeight[i] * std::abs(h) * density).asDiagonal();
    P.topLeftCorner<kSwingMoving, kSwingMoving>() += weighted.lazyProduct(all.transpose());
  }
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

/// What `first` did and then `second`.
Transition after(const Transition& second, const Transition& first) {
  return {second.chain.lazyProduct(first.chain),
          after(second.swing, first.swing, first.chain(2, 2))};
}

/// Belief `dt` later; `all` becomes the transition.
SwingBelief walked(const SwingBelief& belief, double dt, const SwingLaw& law,
                   const SwingNoise& noise, Transition& all) {
  const int steps = stepCount(belief.mean, dt, law);
  SwingVector mean = belief.mean;
  SwingMatrix P = belief.covariance;
  for (int i = 0; i < steps; ++i) {
    const Step one = stepWithTransition(mean, dt / steps, law);
    mean = one.state;
    all = after(one.transition, all);
    P = applied(one.transition, SwingMatrix(applied(one.transition, P).transpose()));
    addGathered(one.F, dt / steps, law, noise, P);
  }
  addWalks(dt, noise, P);
  return {mean, 0.5 * (P + P.transpose())};
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
  Transition all;
  for (int i = 0; i < steps; ++i) {
    const Step one = stepWithTransition(s, dt / steps, law);
    s = one.state;
    all = after(one.transition, all);
  }
  return {s, whole(all)};
}

SwingBeliefWalk walkSwingBeliefWithTransition(const SwingBelief& belief, double dt,
                                              const SwingLaw& law, const SwingNoise& noise) {
  Transition all;
  SwingBeliefWalk result;
  result.belief = walked(belief, dt, law, noise, all);
  result.Phi = whole(all);
  return result;
}

SwingBelief walkSwingBelief(const SwingBelief& belief, double dt, const SwingLaw& law,
                            const SwingNoise& noise) {
  Transition all;
  return walked(belief, dt, law, noise, all);
}

}  // namespace ringhook
