#include "stereo/projection.h"

namespace ringhook {

std::optional<Projection> projectWithJacobian(const PinholeView& view,
                                              const Eigen::Vector3d& point_c1) {
  const Eigen::Vector3d p = view.cMc1 * point_c1;
  if (!(p.z() > 0.0)) {
    return std::nullopt;
  }
  const double x = p.x() / p.z();
  const double y = p.y() / p.z();
  Eigen::Matrix<double, 2, 3> by_p;
  by_p << view.fx, 0.0, -view.fx * x, 0.0, view.fy, -view.fy * y;
  return Projection{{view.fx * x + view.cx, view.fy * y + view.cy},
                    by_p / p.z() * view.cMc1.linear()};
}

}  // namespace ringhook
