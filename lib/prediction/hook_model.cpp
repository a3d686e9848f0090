#include "prediction/hook_model.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "prediction/constant_acceleration.h"

namespace ringhook {
namespace {

using MatrixX = Eigen::MatrixXd;
using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// Places in the state; kPendulum: swing blocks of three, then yaw and the extra hanging length;
// else angle blocks of two.
constexpr int kSwing = 9;
constexpr int kYaw = 15;
constexpr int kLonger = 16;
constexpr int kPendulumStates = 17;
constexpr int kPlainStates = 15;

bool isPendulum(const HookFilterOptions& options) {
  return options.model == HookMotionModel::kPendulum;
}

int stateSize(const HookFilterOptions& options) {
  return isPendulum(options) ? kPendulumStates : kPlainStates;
}

PendulumParameters pendulumOf(const HookFilterOptions& options) {
  return {options.pendulum_length_m, options.mass_kg, options.damping_kg_per_s, options.gravity,
          options.map_step_s};
}

// Up along the shank, in f.
Eigen::Vector3d shankUp(double swing_x, double swing_y) {
  return {std::sin(swing_y), -std::sin(swing_x) * std::cos(swing_y),
          std::cos(swing_x) * std::cos(swing_y)};
}

// Rows 0 to 2: the anchor. kPendulum measures it at pivot_o, the state has the pivot itself, which
// is `longer` further up the shank: y = p - longer * shank. Rows 3 to 5: (swing_x, swing_y, yaw).
Matrix6X measurementMatrix(const HookFilterOptions& options, const Eigen::Vector3d& shank_f) {
  Matrix6X C = Matrix6X::Zero(6, stateSize(options));
  C.topLeftCorner<3, 3>().setIdentity();
  if (!isPendulum(options)) {
    C(3, kSwing) = C(4, kSwing + 2) = C(5, kSwing + 4) = 1.0;
    return C;
  }
  for (int axis = 0; axis < 2; ++axis) {
    C(3 + axis, kSwing + 3 * axis) = 1.0;      // phi
    C(3 + axis, kSwing + 3 * axis + 2) = 1.0;  // rest angle
  }
  C(5, kYaw) = 1.0;
  C.block<3, 1>(0, kLonger) = -shank_f;
  return C;
}

double frequency(const HookFilterOptions& options) {
  return std::sqrt(options.gravity / options.pendulum_length_m);
}

// Square of the swing's amplitude as the state has it [rad^2].
double squaredAmplitude(const HookBelief& belief, int axis, const HookFilterOptions& options) {
  const double phi = belief.mean(kSwing + 3 * axis);
  const double v = belief.mean(kSwing + 3 * axis + 1);
  return phi * phi + v * v / (options.gravity * options.pendulum_length_m);
}

// White noise on phi'' that pays for what the linear law leaves out. A wrong length misses the part
// s/L of the pull, sin(phi) = phi in the mean the part a^2/8 of it, a the whole amplitude; what is
// missed is a sine of that part of w^2 phi, alike for about 1/w.
double swingDensity(const HookBelief& belief, int axis, const HookFilterOptions& options) {
  const double w = frequency(options);
  const double whole = squaredAmplitude(belief, 0, options) + squaredAmplitude(belief, 1, options);
  const double part = std::hypot(options.length_sigma_m / options.pendulum_length_m, whole / 8.0);
  return options.swing_density +
         0.5 * part * part * w * w * w * squaredAmplitude(belief, axis, options);
}

// A suspension that turns about y before x, or a chain, adds up to swing_x * swing_y to the yaw: a
// sine of 2w, of mean square rate (w a_x a_y)^2 / 2, alike for about 1/(2w).
double yawDensity(const HookBelief& belief, const HookFilterOptions& options) {
  return options.yaw_density + 0.25 * frequency(options) * squaredAmplitude(belief, 0, options) *
                                   squaredAmplitude(belief, 1, options);
}

void fillSwings(const HookBelief& belief, double dt, const HookFilterOptions& options, MatrixX& A,
                MatrixX& Q) {
  for (int axis = 0; axis < 2; ++axis) {
    const int at = kSwing + 3 * axis;
    const PendulumWalk walk =
        walkPendulum(pendulumOf(options), dt, swingDensity(belief, axis, options));
    A.block<2, 2>(at, at) = walk.transition;
    Q.block<2, 2>(at, at) = walk.noise;
    Q(at + 2, at + 2) = options.rest_density * std::abs(dt);
  }
  Q(kYaw, kYaw) = yawDensity(belief, options) * std::abs(dt);
  Q(kLonger, kLonger) = options.longer_density * std::abs(dt);
}

void fillTurns(double dt, const HookFilterOptions& options, MatrixX& A, MatrixX& Q) {
  const double t = std::abs(dt);
  Eigen::Matrix2d noise;
  noise << t * t * t / 3, t * dt / 2, t * dt / 2, t;
  for (int at = kSwing; at < kPlainStates; at += 2) {
    A(at, at + 1) = dt;
    Q.block<2, 2>(at, at) = options.hook_turn_density * noise;
  }
}

Eigen::VectorXd priorSigmas(const HookFilterOptions& options) {
  const double w = frequency(options);
  const double anywhere = 1.0;  // [m, rad] about the first fix
  Eigen::VectorXd sigma(stateSize(options));
  sigma.head<3>().setConstant(anywhere);
  sigma.segment<3>(3).setConstant(options.speed_sigma);
  sigma.segment<3>(6).setConstant(isPendulum(options) ? options.belt_acceleration_sigma
                                                      : options.hook_acceleration_sigma);
  if (isPendulum(options)) {
    const Eigen::Vector3d swing(options.swing_sigma,
                                options.pendulum_length_m * w * options.swing_sigma,
                                options.rest_sigma);
    sigma.tail<8>() << swing, swing, anywhere, options.longer_sigma_m;
  } else {
    const Eigen::Vector2d turn(anywhere, w * options.swing_sigma);
    sigma.tail<6>() << turn, turn, turn;
  }
  return sigma;
}

HangingPose hangingOf(const Eigen::Matrix<double, 6, 1>& value) {
  return {value.head<3>(), value(3), value(4), value(5)};
}

Eigen::Vector3d angleRates(const HookBelief& belief, const HookFilterOptions& options) {
  if (!isPendulum(options)) {
    return {belief.mean(kSwing + 1), belief.mean(kSwing + 3), belief.mean(kSwing + 5)};
  }
  const double L = options.pendulum_length_m;
  return {belief.mean(kSwing + 1) / L, belief.mean(kSwing + 4) / L, 0.0};
}

}  // namespace

Eigen::Vector3d anchorInHook(const HookFilterOptions& options) {
  return isPendulum(options) ? options.pivot_o : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

HangingMeasurement hangingMeasurement(const HookFix& fix, const HookFilterOptions& options) {
  const Eigen::Vector3d anchor_o = anchorInHook(options);
  const HangingPose hanging = hangingFromPose(options.fMc1 * fix.c1Mo, anchor_o);
  Covariance6 twist_covariance = fix.covariance;
  twist_covariance.diagonal().head<3>().array() += std::pow(options.position_floor_m, 2);
  twist_covariance.diagonal().tail<3>().array() += std::pow(options.rotation_floor_rad, 2);
  // The inverse of a block triangular matrix whose first block is a rotation.
  const Covariance6 J = hangingJacobian(hanging, anchor_o);
  Covariance6 back = Covariance6::Zero();
  back.topLeftCorner<3, 3>() = J.topLeftCorner<3, 3>().transpose();
  back.bottomRightCorner<3, 3>() = J.bottomRightCorner<3, 3>().inverse();
  back.topRightCorner<3, 3>() =
      -back.topLeftCorner<3, 3>() * J.topRightCorner<3, 3>() * back.bottomRightCorner<3, 3>();
  HangingMeasurement measurement;
  measurement.value << hanging.pivot_f, hanging.swing_x, hanging.swing_y, hanging.yaw;
  measurement.covariance = carried(back, twist_covariance);
  return measurement;
}

HookBelief startHookBelief(const HangingMeasurement& measurement,
                           const HookFilterOptions& options) {
  HookBelief prior;
  prior.mean = Eigen::VectorXd::Zero(stateSize(options));
  prior.mean.head<3>() = measurement.value.head<3>();
  prior.mean(isPendulum(options) ? kYaw : kSwing + 4) = measurement.value(5);
  prior.covariance = priorSigmas(options).cwiseAbs2().asDiagonal();
  return correctHookBelief(prior, measurement, options).belief;
}

HookBelief advanceHookBelief(const HookBelief& belief, double dt,
                             const HookFilterOptions& options) {
  const int size = stateSize(options);
  MatrixX A = MatrixX::Identity(size, size);
  MatrixX Q = MatrixX::Zero(size, size);
  A.topLeftCorner<9, 9>() = accelerationTransition(dt);
  Q.topLeftCorner<9, 9>() =
      jerkNoise(dt, isPendulum(options) ? options.pivot_jerk_density : options.hook_jerk_density);
  if (isPendulum(options)) {
    fillSwings(belief, dt, options, A, Q);
  } else {
    fillTurns(dt, options, A, Q);
  }
  return kalmanPredict<Eigen::Dynamic>(belief, A, Q);
}

Correction<Eigen::Dynamic, 6> correctHookBelief(const HookBelief& belief,
                                                const HangingMeasurement& measurement,
                                                const HookFilterOptions& options) {
  Eigen::Matrix<double, 6, 1> value = measurement.value;
  const Matrix6X C = measurementMatrix(options, shankUp(value(3), value(4)));
  const double yaw = C.row(5).dot(belief.mean);
  value(5) = yaw + std::remainder(value(5) - yaw, 2.0 * std::numbers::pi);
  return kalmanCorrect<Eigen::Dynamic, 6>(belief, value, C, measurement.covariance);
}

HookEstimate composeHookEstimate(const HookBelief& belief, Time time,
                                 const HookFilterOptions& options) {
  Eigen::Vector3d anchor_o = anchorInHook(options);
  // Without its last column the measurement matrix takes out the anchor that the state has.
  Matrix6X C = measurementMatrix(options, Eigen::Vector3d::Zero());
  const HangingPose hanging = hangingOf(product(C, belief.mean));
  if (isPendulum(options)) {
    anchor_o.z() += belief.mean(kLonger);
  }
  Matrix6X JC = product(hangingJacobian(hanging, anchor_o), C);
  if (isPendulum(options)) {
    JC(2, kLonger) = -1.0;  // hanging longer lowers o along its own z
  }
  HookEstimate estimate;
  estimate.time = time;
  estimate.fMo = poseFromHanging(hanging, anchor_o);
  estimate.twist_f =
      hangingTwist(hanging, anchor_o, belief.mean.segment<3>(3), angleRates(belief, options));
  estimate.covariance = carried(JC, belief.covariance);
  return estimate;
}

}  // namespace ringhook
