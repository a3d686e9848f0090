#pragma once

/// \file
/// What may be seen of a swinging thing, and what a belief says about it: the residual of a
/// measurement (seen minus expected) with its derivative by the state. Five kinds:
///   pose              fMo: residual is the twist d of (expected fMo)^-1 * seen fMo, at and in o
///   point             o alone [m]
///   point and pivot   o and the pivot [m]
///   one, two angles   swing_x, or swing_x and swing_y, pivot at rest [rad]

#include <Eigen/Core>

#include "core/pose.h"
#include "core/time.h"
#include "prediction/swing_state.h"

namespace ringhook {

enum class SwingSight { kPose, kPoint, kPointAndPivot, kOneAngle, kTwoAngles };

/// Residuals of a sight: 6, 3, 6, 1, 2.
int swingSightSize(SwingSight sight);

/// At most six numbers, on the stack.
using SwingValue = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using SwingValueCovariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using SwingValueJacobian = Eigen::Matrix<double, Eigen::Dynamic, kSwingStates, 0, 6, kSwingStates>;

struct SwingMeasurement {
  Time time;
  SwingSight sight = SwingSight::kPose;
  Pose fMo = Pose::Identity();      ///< kPose only
  SwingValue value;                 ///< else; point before pivot [m], or angles [rad]
  SwingValueCovariance covariance;  ///< of the residual; pose: twist at and in o [m^2, rad^2]
};

/// Pose of o that a state stands for.
Pose swingPose(const SwingVector& state, const Eigen::Vector3d& pivot_o);

/// Velocity of o, expressed in f [m/s, rad/s].
Twist swingTwist(const SwingVector& state, const Eigen::Vector3d& pivot_o);

/// d (small twist at and in o of swingPose) / d state, 6 x 21.
Eigen::Matrix<double, 6, kSwingStates> swingPoseJacobian(const SwingVector& state,
                                                         const Eigen::Vector3d& pivot_o);

/// What a state says a sight would show: point [m], point and pivot [m], or angles [rad]. Not for
/// kPose, which has no vector.
SwingValue expectedSwingValue(const SwingVector& state, SwingSight sight,
                              const Eigen::Vector3d& pivot_o);

struct SwingInnovation {
  SwingValue residual;   ///< seen minus expected
  SwingValueJacobian H;  ///< d expected / d state
};

SwingInnovation swingInnovation(const SwingVector& state, const SwingMeasurement& measurement,
                                const Eigen::Vector3d& pivot_o);

/// What a measurement did to a belief.
struct SwingCorrection {
  SwingBelief belief;            ///< a posteriori
  double nis = 0.0;              ///< residual^T S^-1 residual
  double log_determinant = 0.0;  ///< of S, for the likelihood
};

/// Extended Kalman correction, Joseph's form (linear_kalman.h).
SwingCorrection correctSwing(const SwingBelief& belief, const SwingMeasurement& measurement,
                             const Eigen::Vector3d& pivot_o);

}  // namespace ringhook
