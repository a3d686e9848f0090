#include "prediction/constant_velocity.h"

namespace ringhook {

Eigen::Matrix2d velocityTransition(double dt) {
  Eigen::Matrix2d A;
  A << 1.0, dt, 0.0, 1.0;
  return A;
}

Eigen::Matrix2d whiteAccelerationNoise(double dt, double density) {
  Eigen::Matrix2d Q;
  Q << dt * dt * dt / 3.0, dt * dt / 2.0, dt * dt / 2.0, dt;
  return density * Q;
}

}  // namespace ringhook
