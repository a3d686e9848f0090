#pragma once

/// \file
/// Robot and camera brought together by points: the way of the 2007 report (Jeyabalan, Fork
/// project), in which the arm carries a marker to the eight corners of a cube, the cameras say
/// where they see it, and a rigid motion is fitted to both lists (rigid_fit.h). The robot's list
/// must hold the marker itself, not the flange: if the flange never turns, an offset between the
/// two cannot be told from a shifted camera.
///
/// Wrong points are found by the least median of squares over triples of points (Rousseeuw 1984)
/// and named. Stereo sees depth worse than the rest, so residuals are given along each camera
/// axis, and the covariance takes them as they are (White's sandwich, Econometrica 48, 1980):
///   H^-1 (sum J^T diag(s_x^2, s_y^2, s_z^2) J) H^-1,   H = sum J^T J.

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "calib/solve/hand_eye.h"

namespace ringhook {

/// Three points fix a motion, a fourth contradicts, a fifth tells who is wrong.
constexpr std::size_t kFewestPoints = 5;

struct PointPair {
  std::string name;         ///< for messages: "points.csv line 5"
  Eigen::Vector3d point_f;  ///< marker in the robot reference, as the arm says [m]
  Eigen::Vector3d point_c;  ///< marker in the left camera, as triangulated [m]
};

struct PointFit {
  Pose fMc1 = Pose::Identity();
  double residual_m = 0.0;  ///< RMS distance over the points used: the report's error value
  double heldout_m = 0.0;   ///< RMS distance of points predicted by a fit without them
  Eigen::Vector3d axis_rms_m = Eigen::Vector3d::Zero();  ///< residuals along x, y, z of the camera
  Covariance6 covariance = Covariance6::Zero();          ///< of the small twist d in fMc1 * exp(d)
  double camera_sigma_m = 0.0;     ///< of the camera's position, largest over directions
  double camera_sigma_rad = 0.0;   ///< of its orientation
  double workspace_sigma_m = 0.0;  ///< of a point in the middle of the points
  double farthest_sigma_m = 0.0;   ///< of the point used that is known worst
  double scale = 1.0;              ///< that the camera's points would need to fit best
  std::vector<double> errors_m;    ///< distance of every point given
  std::vector<bool> used;          ///< one per point given
  std::vector<RejectedPair> rejected;
  Verdict verdict;
};

/// Reads points.csv (doc/formats.md). Throws InputError naming file, line and column.
std::vector<PointPair> readPointPairs(const std::filesystem::path& file);

/// The whole job. Throws InputError below kFewestPoints points or for points on one line.
PointFit fitPoints(const std::vector<PointPair>& points);

}  // namespace ringhook
