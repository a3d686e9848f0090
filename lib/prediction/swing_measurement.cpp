#include "prediction/swing_measurement.h"

#include <Eigen/Cholesky>

#include "prediction/hanging_pose.h"

namespace ringhook {
namespace {

HangingPose hangingOf(const SwingVector& s) {
  return {s.segment<3>(kSwingPivot), s(kSwingAngle) + s(kSwingRest),
          s(kSwingAngle + 1) + s(kSwingRest + 1), s(kSwingYaw)};
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
  return poseFromHanging(hangingOf(state), pivotOf(state, pivot_o));
}

Twist swingTwist(const SwingVector& state, const Eigen::Vector3d& pivot_o) {
  const Eigen::Vector3d rates(state(kSwingRate), state(kSwingRate + 1), 0.0);
  return hangingTwist(hangingOf(state), pivotOf(state, pivot_o), state.segment<3>(kSwingSpeed),
                      rates);
}

Eigen::Matrix<double, 6, kSwingStates> swingPoseJacobian(const SwingVector& state,
                                                         const Eigen::Vector3d& pivot_o) {
  const Eigen::Matrix<double, 6, 6> hanging =
      hangingJacobian(hangingOf(state), pivotOf(state, pivot_o));
  Eigen::Matrix<double, 6, kSwingStates> J = Eigen::Matrix<double, 6, kSwingStates>::Zero();
  J.middleCols<3>(kSwingPivot) = hanging.leftCols<3>();
  J.middleCols<2>(kSwingAngle) = hanging.middleCols<2>(3);
  J.middleCols<2>(kSwingRest) = hanging.middleCols<2>(3);
  J.col(kSwingYaw) = hanging.col(5);
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
