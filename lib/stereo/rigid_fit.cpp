#include "stereo/rigid_fit.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "stereo/plane_fit.h"

namespace ringhook {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Outcome<RigidFit> fitRigid(const std::vector<Vector3d>& points_a,
                           const std::vector<Vector3d>& points_b) {
  if (points_a.size() != points_b.size()) {
    return Refusal{"numbers of points differ"};
  }
  // Centroids, and refusal of what leaves a rotation open.
  const auto a = fitPlane(points_a);
  const auto b = fitPlane(points_b);
  if (!a || !b) {
    return Refusal{a ? b.reason() : a.reason()};
  }
  Matrix3d cross = Matrix3d::Zero();
  for (std::size_t i = 0; i < points_a.size(); ++i) {
    cross += (points_a[i] - a->centroid) * (points_b[i] - b->centroid).transpose();
  }
  const Eigen::JacobiSVD<Matrix3d> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d mirror = Matrix3d::Identity();
  mirror(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  RigidFit fit;
  fit.aMb = Pose::Identity();
  fit.aMb.linear() = svd.matrixU() * mirror * svd.matrixV().transpose();
  fit.aMb.translation() = a->centroid - fit.aMb.linear() * b->centroid;
  double sum = 0.0;
  for (std::size_t i = 0; i < points_a.size(); ++i) {
    sum += (points_a[i] - fit.aMb * points_b[i]).squaredNorm();
  }
  fit.rms = std::sqrt(sum / static_cast<double>(points_a.size()));
  return fit;
}

}  // namespace ringhook
