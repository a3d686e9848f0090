#pragma once

/// \file
/// Where the flange of a Stäubli RX60 is, how it moves, and which joint angles put it somewhere.
///
/// Law: modified Denavit-Hartenberg rows (alpha_{i-1}, a_{i-1}, d_i, theta offset; Craig,
/// "Introduction to Robotics", 3rd ed., section 3.4)
///   (0, 0, base_height, 0) (-90deg, 0, 0, -90deg) (0, upper_arm, shoulder_offset, +90deg)
///   (+90deg, 0, forearm, 0) (-90deg, 0, 0, 0) (+90deg, 0, flange, 0),
/// so that all zeros stretch the arm straight up. Lengths, joint ranges and speeds: Stäubli, "RX
/// series 60B family", arm manual D28045004E, 2008. The wrist is spherical, hence the inverse is
/// closed (Pieper 1968): wrist centre -> joints 1 to 3, remaining Z-Y-Z rotation -> joints 4 to 6,
/// two choices each at shoulder, elbow and wrist: eight branches.

#include <array>
#include <vector>

#include "core/joints.h"
#include "core/outcome.h"
#include "core/pose.h"

namespace ringhook::rx60 {

/// Lengths of one arm of the family.
struct Geometry {
  double base_height;      ///< from the floor of the arm to the axis of joint 2 [m]
  double shoulder_offset;  ///< of the arm's plane from the axis of joint 1, along joint 2 [m]
  double upper_arm;        ///< from the axis of joint 2 to that of joint 3 [m]
  double forearm;          ///< from the axis of joint 3 to the wrist centre [m]
  double flange;           ///< from the wrist centre to the flange [m]
  /// True minus reported joint angles [rad], of an arm whose zeros were calibrated. All angles of
  /// this file are reported ones, before and behind the law alike.
  JointVector zero = JointVector::Zero();
};

Geometry rx60();
Geometry rx60L();

/// Greatest speed of the flange that the maker allows [m/s].
inline constexpr double kCartesianSpeedLimit = 1.8;

/// Ranges and nominal speeds as published, the same for both arms. The maker publishes no
/// accelerations and jerks: ours assume nominal speed after 0.25 s (20 rad/s^2 at joints 1 and 2)
/// and full acceleration after 0.04 s: values to be replaced by what a user's arm is measured to
/// do.
JointLimits limits();

/// fMe at joint angles q [rad].
Pose forward(const Geometry& geometry, const JointVector& q);

/// fJe: the flange's twist at e, expressed in f (linear [m/s] over angular [rad/s]), per joint
/// velocity [rad/s].
Jacobian jacobian(const Geometry& geometry, const JointVector& q);

/// Poses of the six link frames in f; frame i turns about its own z with joint i+1.
std::array<Pose, 6> linkFrames(const Geometry& geometry, const JointVector& q);

/// The arm as a polyline in f [m], for drawing and for collision checks.
struct LinkPoints {
  Eigen::Vector3d base;       ///< origin of f
  Eigen::Vector3d shoulder;   ///< where the axes of joints 1 and 2 meet
  Eigen::Vector3d upper_arm;  ///< foot of the upper arm, shoulder_offset along the axis of joint 2
  Eigen::Vector3d elbow;      ///< on the axis of joint 3
  Eigen::Vector3d wrist;      ///< where the axes of joints 4, 5 and 6 meet
  Eigen::Vector3d flange;     ///< origin of e
};
LinkPoints linkPoints(const Geometry& geometry, const JointVector& q);

enum class Shoulder { kFront, kBack };      ///< wrist before or behind the axis of joint 1
enum class Elbow { kPositive, kNegative };  ///< sign of joint 3
enum class Wrist { kPositive, kNegative };  ///< sign of joint 5

/// One branch of the inverse.
struct InverseSolution {
  JointVector q;  ///< [rad], each in [-pi, pi]; joint limits are not looked at
  Shoulder shoulder = Shoulder::kFront;
  Elbow elbow = Elbow::kPositive;
  Wrist wrist = Wrist::kPositive;
  bool wrist_singular = false;  ///< sin q5 = 0: only q4 + q6 is determined, q4 = 0 was chosen
};
using InverseSolutions = std::vector<InverseSolution>;

/// All branches that reach fMe: eight, or fewer where two coincide (stretched elbow, sin q5 = 0
/// with a given elbow: the positive one is returned). Refuses poses out of reach: wrist too far or
/// too near, or closer to the axis of joint 1 than the shoulder offset; poses that are not finite.
/// On the edge of that cylinder front and back coincide and both are returned.
Outcome<InverseSolutions> inverse(const Geometry& geometry, const Pose& fMe);

/// Every joint vector within the limits that equals q up to full turns of joints 4 and 6.
std::vector<JointVector> expandTurns(const JointVector& q, const JointLimits& limits);

/// The solution within the limits nearest to q_reference [rad]: least sum of squared joint
/// distances, each divided by that joint's speed limit. With a singular wrist joint 4 stays at
/// its reference as far as the limits allow. Refuses with the reason: out of reach, or by how much
/// the best branch leaves the limits.
Outcome<JointVector> nearestInverse(const Geometry& geometry, const JointLimits& limits,
                                    const Pose& fMe, const JointVector& q_reference);

}  // namespace ringhook::rx60
