#include "prediction/van_loan.h"

#include <cassert>
#include <unsupported/Eigen/MatrixFunctions>

#include "prediction/linear_kalman.h"

namespace ringhook {

SampledLaw sampleLaw(const Eigen::MatrixXd& drift, const Eigen::MatrixXd& density, double dt) {
  assert(dt >= 0.0);
  const Eigen::Index n = drift.rows();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  M.topLeftCorner(n, n) = -dt * drift;
  M.topRightCorner(n, n) = dt * density;
  M.bottomRightCorner(n, n) = dt * drift.transpose();
  const Eigen::MatrixXd E = M.exp();
  SampledLaw law;
  law.transition = E.bottomRightCorner(n, n).transpose();
  const Eigen::MatrixXd Q = product(law.transition, Eigen::MatrixXd(E.topRightCorner(n, n)));
  law.noise = 0.5 * (Q + Q.transpose());
  return law;
}

}  // namespace ringhook
