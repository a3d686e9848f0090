#pragma once

/// \file
/// Rigid poses and twists. `aMb` is the pose of b in a and takes b-coordinates to a-coordinates;
/// inner letters meet: fMo = fMc1 * c1Mo. The alphabet of frames is drawn in doc/frames.md.
/// A twist stacks linear over angular velocity, (v, w), the order of ViSP and of Craig's
/// Jacobians; its suffix names the frame in which it is expressed.
/// Source of the exponential and logarithm: Murray, Li, Sastry, "A Mathematical Introduction to
/// Robotic Manipulation", 1994, section 2.3.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ringhook {

using Pose = Eigen::Isometry3d;                   ///< aMb; translation [m]
using Twist = Eigen::Matrix<double, 6, 1>;        ///< linear [m/s] over angular [rad/s]
using Covariance6 = Eigen::Matrix<double, 6, 6>;  ///< translation [m^2] over rotation [rad^2]

/// Pose from a position [m] and a rotation; the quaternion is normalised.
Pose makePose(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation);

/// Pose from a position [m] and a rotation vector theta*u [rad] (ViSP's theta-u).
Pose makePoseThetaU(const Eigen::Vector3d& position, const Eigen::Vector3d& theta_u);

/// Rotation vector theta*u [rad], |theta| <= pi, of a rotation matrix.
Eigen::Vector3d thetaU(const Eigen::Matrix3d& rotation);

/// Skew-symmetric matrix with skew(a) b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Motion of a body that keeps `twist_b` (expressed in the body's own frame) for one unit of time:
/// aMb' = aMb * exp(twist_b).
Pose expSe3(const Twist& twist_b);

/// Inverse of expSe3 for rotations below pi.
Twist logSe3(const Pose& aMb);

/// Twist of a body given at frame b and expressed in b, re-expressed at and in frame a:
/// twist_a = twistTransform(aMb) * twist_b (ViSP's velocity twist matrix aVb).
Eigen::Matrix<double, 6, 6> twistTransform(const Pose& aMb);

/// Pose between a and b: position straight, rotation by slerp; s = 0 gives a, s = 1 gives b.
Pose interpolate(const Pose& a, const Pose& b, double s);

}  // namespace ringhook
