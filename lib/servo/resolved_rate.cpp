#include "servo/resolved_rate.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace ringhook {

Twist flangeTwist(const Pose& fMe, const Pose& eMr, const Twist& twist_r) {
  const Twist twist_e = twistTransform(eMr) * twist_r;
  Twist twist_f;
  twist_f << fMe.linear() * twist_e.head<3>(), fMe.linear() * twist_e.tail<3>();
  return twist_f;
}

ResolvedRate resolve(const Twist& twist_f, const Jacobian& fJe,
                     const ResolvedRateOptions& options) {
  ResolvedRate resolved;
  resolved.manipulability = std::abs(fJe.determinant());
  const double ratio = resolved.manipulability / options.manipulability_threshold;
  resolved.damped = ratio < 1.0;
  if (resolved.damped) {
    const double lambda = options.damping * (1.0 - ratio);
    const Jacobian normal = fJe * fJe.transpose() + lambda * lambda * Jacobian::Identity();
    resolved.velocity = fJe.transpose() * normal.ldlt().solve(twist_f);
  } else {
    resolved.velocity = fJe.partialPivLu().solve(twist_f);
  }
  return resolved;
}

}  // namespace ringhook
