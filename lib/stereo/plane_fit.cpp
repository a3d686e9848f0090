#include "stereo/plane_fit.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

namespace ringhook {

constexpr double kOneLine = 1e-3;

Outcome<Plane> fitPlane(const std::vector<Eigen::Vector3d>& points) {
  const auto n = static_cast<Eigen::Index>(points.size());
  if (n < 3) {
    return Refusal{"fewer than three points"};
  }
  Eigen::Matrix3Xd centred(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    centred.col(i) = points[static_cast<std::size_t>(i)];
  }
  Plane plane;
  plane.centroid = centred.rowwise().mean();
  centred.colwise() -= plane.centroid;
  const Eigen::JacobiSVD<Eigen::Matrix3Xd> svd(centred, Eigen::ComputeFullU);
  const Eigen::Vector3d scatter = svd.singularValues();
  if (!(scatter[1] > kOneLine * scatter[0])) {
    return Refusal{"points on one line"};
  }
  plane.axes = svd.matrixU();
  plane.axes.col(2) = plane.axes.col(0).cross(plane.axes.col(1));
  plane.rms = scatter[2] / std::sqrt(static_cast<double>(n));
  return plane;
}

}  // namespace ringhook
