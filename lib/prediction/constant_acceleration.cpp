#include "prediction/constant_acceleration.h"

#include <cmath>

#include "prediction/chi_square.h"

namespace ringhook {

Matrix9 accelerationTransition(double dt) {
  Matrix9 A = Matrix9::Identity();
  A.block<3, 3>(0, 3).diagonal().setConstant(dt);
  A.block<3, 3>(3, 6).diagonal().setConstant(dt);
  A.block<3, 3>(0, 6).diagonal().setConstant(0.5 * dt * dt);
  return A;
}

Matrix9 jerkNoise(double dt, double jerk_density) {
  const double t = std::abs(dt);
  const double sign = dt < 0.0 ? -1.0 : 1.0;  // backwards, odd derivatives change sign
  Eigen::Matrix3d q;
  q << std::pow(t, 5) / 20, sign * std::pow(t, 4) / 8, std::pow(t, 3) / 6,  //
      sign * std::pow(t, 4) / 8, std::pow(t, 3) / 3, sign * t * t / 2,      //
      std::pow(t, 3) / 6, sign * t * t / 2, t;
  Matrix9 Q = Matrix9::Zero();
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) {
      Q.block<3, 3>(3 * row, 3 * col).diagonal().setConstant(jerk_density * q(row, col));
    }
  }
  return Q;
}

Matrix9 reportNoise(double sigma_position, double sigma_velocity, double sigma_acceleration) {
  Vector9 sigma;
  sigma << Eigen::Vector3d::Constant(sigma_position), Eigen::Vector3d::Constant(sigma_velocity),
      Eigen::Vector3d::Constant(sigma_acceleration);
  return sigma.cwiseAbs2().asDiagonal();
}

Matrix39 positionMeasurement() {
  Matrix39 C = Matrix39::Zero();
  C.leftCols<3>().setIdentity();
  return C;
}

ConstantAccelerationFilter::ConstantAccelerationFilter(const ConstantAccelerationOptions& options)
    : options_(options) {
  if (options.gate_probability > 0.0) {
    gate_ = chiSquareQuantile(options.gate_probability, 3.0);
  }
}

Gaussian<9> ConstantAccelerationFilter::ahead(Time time) const {
  const double dt = time - *time_;
  const Matrix9 Q = options_.fixed_noise ? *options_.fixed_noise  //
                                         : jerkNoise(dt, options_.jerk_density);
  return kalmanPredict<9>(belief_, accelerationTransition(dt), Q);
}

Outcome<FilterUpdate> ConstantAccelerationFilter::update(Time time, const Eigen::Vector3d& position,
                                                         const Eigen::Matrix3d& covariance) {
  if (!position.allFinite() || !covariance.allFinite()) {
    return Refusal{"not finite"};
  }
  if (!time_) {
    belief_.mean << position, Vector9::Zero().tail<6>();
    belief_.covariance = reportNoise(0.0, options_.speed_sigma, options_.acceleration_sigma);
    belief_.covariance.topLeftCorner<3, 3>() = covariance;
    time_ = time;
    return FilterUpdate{time, 0.0, 3};
  }
  if (time <= *time_) {
    return Refusal{"late or duplicate time stamp"};
  }
  const auto correction =
      kalmanCorrect<9, 3>(ahead(time), position, positionMeasurement(), covariance);
  if (gate_ > 0.0 && !(correction.nis <= gate_)) {
    return Refusal{"outside the gate"};
  }
  belief_ = correction.belief;
  time_ = time;
  return FilterUpdate{time, correction.nis, 3};
}

Outcome<Gaussian<9>> ConstantAccelerationFilter::predict(Time time) const {
  if (!time_) {
    return Refusal{"no measurement yet"};
  }
  return ahead(time);
}

}  // namespace ringhook
