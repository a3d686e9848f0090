#include "robot/rx60/kinematics.h"

#include <cmath>
#include <numbers>

#include "core/angle.h"

namespace ringhook::rx60 {
namespace {

/// One row of the modified Denavit-Hartenberg table, times the joint's rotation.
Pose craigLink(double sin_alpha, double cos_alpha, double a, double d, double theta) {
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  Pose link = Pose::Identity();
  link.linear() << c, -s, 0.0,                   //
      s * cos_alpha, c * cos_alpha, -sin_alpha,  //
      s * sin_alpha, c * sin_alpha, cos_alpha;
  link.translation() << a, -sin_alpha * d, cos_alpha * d;
  return link;
}

JointVector degrees(double j1, double j2, double j3, double j4, double j5, double j6) {
  JointVector q;
  q << j1, j2, j3, j4, j5, j6;
  return q * kDegree;
}

}  // namespace

Geometry rx60() { return {0.341, 0.049, 0.290, 0.310, 0.065, JointVector::Zero()}; }

Geometry rx60L() { return {0.341, 0.049, 0.400, 0.400, 0.065, JointVector::Zero()}; }

JointLimits limits() {
  constexpr double kTimeToNominalSpeed = 0.25;      // [s], the assumptions named in the header
  constexpr double kTimeToFullAcceleration = 0.04;  // [s]
  JointLimits limits;
  limits.lower = degrees(-160.0, -127.5, -134.5, -270.0, -109.5, -270.0);
  limits.upper = degrees(160.0, 127.5, 134.5, 270.0, 120.5, 270.0);
  limits.velocity = degrees(287.0, 287.0, 319.0, 410.0, 320.0, 700.0);
  limits.acceleration = limits.velocity / kTimeToNominalSpeed;
  limits.jerk = limits.acceleration / kTimeToFullAcceleration;
  return limits;
}

std::array<Pose, 6> linkFrames(const Geometry& g, const JointVector& reported) {
  constexpr double kQuarter = std::numbers::pi / 2.0;
  const JointVector q = reported + g.zero;
  std::array<Pose, 6> frames;
  frames[0] = craigLink(0.0, 1.0, 0.0, g.base_height, q(0));
  frames[1] = frames[0] * craigLink(-1.0, 0.0, 0.0, 0.0, q(1) - kQuarter);
  frames[2] = frames[1] * craigLink(0.0, 1.0, g.upper_arm, g.shoulder_offset, q(2) + kQuarter);
  frames[3] = frames[2] * craigLink(1.0, 0.0, 0.0, g.forearm, q(3));
  frames[4] = frames[3] * craigLink(-1.0, 0.0, 0.0, 0.0, q(4));
  frames[5] = frames[4] * craigLink(1.0, 0.0, 0.0, g.flange, q(5));
  return frames;
}

Pose forward(const Geometry& geometry, const JointVector& q) {
  return linkFrames(geometry, q).back();
}

Jacobian jacobian(const Geometry& geometry, const JointVector& q) {
  const std::array<Pose, 6> frames = linkFrames(geometry, q);
  const Eigen::Vector3d flange = frames.back().translation();
  Jacobian fJe;
  for (int i = 0; i < 6; ++i) {
    const Pose& frame = frames[static_cast<std::size_t>(i)];
    const Eigen::Vector3d axis = frame.linear().col(2);
    fJe.col(i) << axis.cross(flange - frame.translation()), axis;
  }
  return fJe;
}

LinkPoints linkPoints(const Geometry& geometry, const JointVector& q) {
  const std::array<Pose, 6> frames = linkFrames(geometry, q);
  LinkPoints points;
  points.base.setZero();
  points.shoulder = frames[1].translation();
  points.upper_arm = points.shoulder + geometry.shoulder_offset * frames[1].linear().col(2);
  points.elbow = frames[2].translation();
  points.wrist = frames[3].translation();
  points.flange = frames[5].translation();
  return points;
}

}  // namespace ringhook::rx60
