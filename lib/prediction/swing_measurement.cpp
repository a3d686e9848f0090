#include "prediction/swing_measurement.h"

#include <Eigen/Cholesky>

namespace ringhook {
namespace {

Eigen::Matrix3d turn(double angle, int axis) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}

/// The turns that make up fRo, one after the other.
struct SwingTurns {
  Eigen::Matrix3d Rx;     ///< swing_x
  Eigen::Matrix3d Rxy;    ///< and swing_y: what gravity knows
  Eigen::Matrix3d Rrest;  ///< and rest_x
  Eigen::Matrix3d fRo;    ///< and rest_y, yaw
};

SwingTurns turnsOf(const SwingVector& s) {
  SwingTurns turns;
  turns.Rx = turn(s(kSwingAngle), 0);
  turns.Rxy = turns.Rx * turn(s(kSwingAngle + 1), 1);
  turns.Rrest = turns.Rxy * turn(s(kSwingRest), 0);
  turns.fRo = turns.Rrest * turn(s(kSwingRest + 1), 1) * turn(s(kSwingYaw), 2);
  return turns;
}

Eigen::Vector3d pivotOf(const SwingVector& s, const Eigen::Vector3d& pivot_o) {
  return pivot_o + Eigen::Vector3d(0.0, 0.0, s(kSwingLonger));
}

// Rows of o's position in f: the pose's translation rows turned from o into f.
Eigen::Matrix<double, 3, kSwingStates> pointJacobian(const SwingVector& s,
                                                     const Eigen::Vector3d& pivot_o) {
  const Pose fMo = swingPose(s, pivot_o);
  return product(Eigen::Matrix3d(fMo.linear()), Eigen::Matrix<double, 3, kSwingStates>(
                                                    swingPoseJacobian(s, pivot_o).topRows<3>()));
}

template <int M>
SwingCorrection corrected(const SwingBelief& belief, const SwingInnovation& innovation,
                          const SwingValueCovariance& R) {
  const Eigen::Matrix<double, M, kSwingStates> H = innovation.H;
  const Eigen::Matrix<double, M, 1> y = innovation.residual + product(H, belief.mean);
  const auto correction =
      kalmanCorrect<kSwingStates, M>(belief, y, H, Eigen::Matrix<double, M, M>(R));
  const Eigen::Matrix<double, M, M> lower = correction.innovation_covariance.llt().matrixL();
  return {correction.belief, correction.nis, 2.0 * lower.diagonal().array().log().sum()};
}

}  // namespace

int swingSightSize(SwingSight sight) {
  switch (sight) {
    case SwingSight::kOneAngle:
      return 1;
    case SwingSight::kTwoAngles:
      return 2;
    case SwingSight::kPoint:
      return 3;
    case SwingSight::kPose:
    case SwingSight::kPointAndPivot:
      return 6;
  }
  return 0;
}

Pose swingPose(const SwingVector& state, const Eigen::Vector3d& pivot_o) {
  Pose fMo = Pose::Identity();
  fMo.linear() = turnsOf(state).fRo;
  fMo.translation() = state.segment<3>(kSwingPivot) - fMo.linear() * pivotOf(state, pivot_o);
  return fMo;
}

Twist swingTwist(const SwingVector& state, const Eigen::Vector3d& pivot_o) {
  const SwingTurns turns = turnsOf(state);
  const Eigen::Vector3d w_f =
      state(kSwingRate) * Eigen::Vector3d::UnitX() + state(kSwingRate + 1) * turns.Rx.col(1);
  Twist twist;
  twist << state.segment<3>(kSwingSpeed) - w_f.cross(turns.fRo * pivotOf(state, pivot_o)), w_f;
  return twist;
}

Eigen::Matrix<double, 6, kSwingStates> swingPoseJacobian(const SwingVector& state,
                                                         const Eigen::Vector3d& pivot_o) {
  const SwingTurns turns = turnsOf(state);
  const Eigen::Matrix3d oRf = turns.fRo.transpose();
  Eigen::Matrix<double, 6, kSwingStates> J = Eigen::Matrix<double, 6, kSwingStates>::Zero();
  J.block<3, 3>(0, kSwingPivot) = oRf;
  J.block<3, 1>(3, kSwingAngle) = oRf.col(0);
  J.block<3, 1>(3, kSwingAngle + 1) = oRf * turns.Rx.col(1);
  J.block<3, 1>(3, kSwingRest) = oRf * turns.Rxy.col(0);
  J.block<3, 1>(3, kSwingRest + 1) = oRf * turns.Rrest.col(1);
  J(5, kSwingYaw) = 1.0;
  const Eigen::Matrix3d lever = skew(pivotOf(state, pivot_o));
  for (const int place :
       {int{kSwingAngle}, kSwingAngle + 1, int{kSwingRest}, kSwingRest + 1, int{kSwingYaw}}) {
    J.block<3, 1>(0, place) = lever * J.block<3, 1>(3, place);
  }
  J(2, kSwingLonger) = -1.0;  // hanging longer lowers o along its own z
  return J;
}

SwingValue expectedSwingValue(const SwingVector& state, SwingSight sight,
                              const Eigen::Vector3d& pivot_o) {
  SwingValue value(swingSightSize(sight));
  switch (sight) {
    case SwingSight::kOneAngle:
      value(0) = state(kSwingAngle);
      break;
    case SwingSight::kTwoAngles:
      value = state.segment<2>(kSwingAngle);
      break;
    case SwingSight::kPointAndPivot:
      value.tail(3) = state.segment<3>(kSwingPivot);
      [[fallthrough]];
    case SwingSight::kPoint:
    case SwingSight::kPose:
      value.head(3) = swingPose(state, pivot_o).translation();
  }
  return value;
}

SwingInnovation swingInnovation(const SwingVector& state, const SwingMeasurement& measurement,
                                const Eigen::Vector3d& pivot_o) {
  SwingInnovation innovation;
  innovation.H = SwingValueJacobian::Zero(swingSightSize(measurement.sight), kSwingStates);
  if (measurement.sight == SwingSight::kPose) {
    innovation.residual = logSe3(swingPose(state, pivot_o).inverse() * measurement.fMo);
    innovation.H = swingPoseJacobian(state, pivot_o);
    return innovation;
  }
  innovation.residual = measurement.value - expectedSwingValue(state, measurement.sight, pivot_o);
  switch (measurement.sight) {
    case SwingSight::kTwoAngles:
      innovation.H(1, kSwingAngle + 1) = 1.0;
      [[fallthrough]];
    case SwingSight::kOneAngle:
      innovation.H(0, kSwingAngle) = 1.0;
      break;
    case SwingSight::kPointAndPivot:
      innovation.H.block<3, 3>(3, kSwingPivot).setIdentity();
      [[fallthrough]];
    default:
      innovation.H.topRows<3>() = pointJacobian(state, pivot_o);
  }
  return innovation;
}

SwingCorrection correctSwing(const SwingBelief& belief, const SwingMeasurement& measurement,
                             const Eigen::Vector3d& pivot_o) {
  const SwingInnovation innovation = swingInnovation(belief.mean, measurement, pivot_o);
  switch (measurement.sight) {
    case SwingSight::kOneAngle:
      return corrected<1>(belief, innovation, measurement.covariance);
    case SwingSight::kTwoAngles:
      return corrected<2>(belief, innovation, measurement.covariance);
    case SwingSight::kPoint:
      return corrected<3>(belief, innovation, measurement.covariance);
    default:
      return corrected<6>(belief, innovation, measurement.covariance);
  }
}

}  // namespace ringhook
