#pragma once

/// \file
/// Rigid motion between two sets of corresponding points by least squares: the rotation is U V^T of
/// the cross-covariance's singular vectors, its last column turned where that would reflect (Arun,
/// Huang, Blostein 1987; Umeyama 1991, without scale).

#include <Eigen/Core>
#include <vector>

#include "core/outcome.h"
#include "core/pose.h"

namespace ringhook {

struct RigidFit {
  Pose aMb;          ///< takes points_b to points_a
  double rms = 0.0;  ///< distance after the fit [m]
};

/// Points in frames a and b [m], one for one. Refuses "numbers of points differ", "fewer than three
/// points" and "points on one line".
Outcome<RigidFit> fitRigid(const std::vector<Eigen::Vector3d>& points_a,
                           const std::vector<Eigen::Vector3d>& points_b);

}  // namespace ringhook
