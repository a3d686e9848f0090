#include "stereo/plane_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

namespace ringhook {

constexpr double kOneLine = 1e-3;

Outcome<Plane> fitPlane(const std::vector<Eigen::Vector3d>& points) {
  const auto n = static_cast<double>(points.size());
  if (points.size() < 3) {
    return Refusal{"fewer than three points"};
  }
  Plane plane;
  plane.centroid.setZero();
  for (const Eigen::Vector3d& p : points) {
    plane.centroid += p / n;
  }
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    scatter += (p - plane.centroid) * (p - plane.centroid).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);  // smallest first
  const Eigen::Vector3d& squares = solver.eigenvalues();
  if (!(squares[1] > kOneLine * kOneLine * squares[2])) {
    return Refusal{"points on one line"};
  }
  plane.axes.col(0) = solver.eigenvectors().col(2);
  plane.axes.col(1) = solver.eigenvectors().col(1);
  plane.axes.col(2) = plane.axes.col(0).cross(plane.axes.col(1));
  // From the points, as the root of a rounded eigenvalue has half its digits only.
  for (const Eigen::Vector3d& p : points) {
    plane.rms += std::pow(plane.normal().dot(p - plane.centroid), 2) / n;
  }
  plane.rms = std::sqrt(plane.rms);
  return plane;
}

}  // namespace ringhook
