#pragma once

/// \file
/// What a new set of views says of an accepted rig, by least squares. The target's pose is free in
/// every view; the rig is held as accepted, or is allowed some changes:
///   c2Mc1' = exp(d) c2Mc1   the right camera against the left, twist d in c2 (6 parameters),
///   f1' = f1 (1 + s1), f2' = f2 (1 + s2)   the focal lengths (2 parameters).
/// Minimised is the sum of squared pixel residuals of both images by Gauss-Newton; the poses are
/// eliminated view by view (Schur complement; Triggs et al., "Bundle Adjustment, a Modern
/// Synthesis", 2000). With S0, S1 the sums without and with k changes and noise sigma,
/// (S0 - S1) / sigma^2 follows chi-square with k degrees of freedom as long as the accepted rig
/// still holds (likelihood ratio; Wilks, Annals of Mathematical Statistics 9, 1938).

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/pose.h"
#include "rig/stereo_rig.h"

namespace ringhook {

/// The points of one target that both cameras saw at one instant.
struct SightedView {
  std::string name;                       ///< for messages, a file name
  std::vector<Eigen::Vector3d> points_t;  ///< in the target's frame [m], at least four
  std::vector<Eigen::Vector2d> left_px;   ///< where they were seen, raw image [px]
  std::vector<Eigen::Vector2d> right_px;  ///< likewise
};

/// What may change: rotation and translation of the right camera, both focal lengths.
struct RigChanges {
  bool pose = false;
  bool focal = false;
};

using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

struct RigFit {
  StereoRig rig;                         ///< with the changes in it
  std::vector<Pose> c1Mt;                ///< of every view
  double squares = 0.0;                  ///< sum of squared residuals [px^2]
  int residuals = 0;                     ///< scalar ones, four a point
  int freedom = 0;                       ///< residuals less parameters
  Vector8 change = Vector8::Zero();      ///< d: translation [m], rotation [rad]; s1, s2
  Matrix8 covariance = Matrix8::Zero();  ///< of `change` for noise of 1 px per axis
};

/// Fits all views. `start` gives rig and poses from which to start. Throws Error if the minimum is
/// not reached.
RigFit fitRig(const RigFit& start, const std::vector<SightedView>& views, const RigChanges& free);

/// The accepted rig with the poses that triangulated points suggest. Throws InputError naming the
/// view in which the points contradict the rig grossly (wrong target, views that are no pairs).
RigFit startFit(const StereoRig& rig, const std::vector<SightedView>& views);

/// Where the rig sees the points of a view, from both pixels, midpoint of the rays [m in c1].
/// Throws InputError naming the view for rays that do not meet in front of the cameras.
std::vector<Eigen::Vector3d> locatePoints(const StereoRig& rig, const SightedView& view);

}  // namespace ringhook
