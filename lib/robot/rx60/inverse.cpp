#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>

#include "core/angle.h"
#include "robot/rx60/kinematics.h"

namespace ringhook::rx60 {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
/// Slack for rounding at the edge of the workspace: on a cosine, and on a length squared [m^2].
constexpr double kRounding = 1e-12;
/// sin q5 below which joint 4 cannot be told from joint 6; the rotation is then off by no more
/// than twice this [rad].
constexpr double kSingularWrist = 1e-10;
/// Joint limits count as kept up to this [rad]: rounding of an arm standing on its limit.
constexpr double kLimitRounding = 1e-9;

double wrapped(double angle) { return std::remainder(angle, 2.0 * kPi); }

/// The triangle shoulder - elbow - wrist, common to all branches.
struct Reach {
  double horizontal;  ///< |rr|: wrist from the axis of joint 1, within the arm's plane [m]
  double height;      ///< wrist above the axis of joint 2 [m]
  double cos_elbow;   ///< cosine of joint 3
};

Refusal outOfReach(const char* what, double is, double bound) {
  char text[120];
  std::snprintf(text, sizeof text, "out of reach: wrist centre %.3f m from %s %.3f m", is, what,
                bound);
  return {text};
}

Vector3d wristCentre(const Geometry& g, const Pose& fMe) {
  return fMe.translation() - g.flange * fMe.linear().col(2);
}

/// Unclamped: the square of the horizontal reach [m^2] and the cosine of joint 3.
struct RawReach {
  double horizontal2;
  double distance2;
  double cos_elbow;
};

RawReach rawReach(const Geometry& g, const Vector3d& wrist) {
  const double z = wrist.z() - g.base_height;
  const double horizontal2 = wrist.head<2>().squaredNorm() - g.shoulder_offset * g.shoulder_offset;
  const double distance2 = horizontal2 + z * z;
  const double cosine = (distance2 - g.upper_arm * g.upper_arm - g.forearm * g.forearm) /
                        (2.0 * g.upper_arm * g.forearm);
  return {horizontal2, distance2, cosine};
}

/// Why no branch reaches fMe; nothing if one does.
std::optional<Refusal> unreachable(const Geometry& g, const Pose& fMe) {
  if (!fMe.matrix().allFinite()) {
    return Refusal{"pose is not finite"};
  }
  const Vector3d wrist = wristCentre(g, fMe);
  const RawReach raw = rawReach(g, wrist);
  if (raw.horizontal2 < -kRounding) {
    return outOfReach("the axis of joint 1, at least", wrist.head<2>().norm(), g.shoulder_offset);
  }
  if (raw.cos_elbow > 1.0 + kRounding) {
    return outOfReach("the shoulder, at most", std::sqrt(raw.distance2), g.upper_arm + g.forearm);
  }
  if (raw.cos_elbow < -1.0 - kRounding) {
    return outOfReach("the shoulder, at least", std::sqrt(raw.distance2),
                      std::abs(g.upper_arm - g.forearm));
  }
  return std::nullopt;
}

/// Precondition: reachable.
Reach reachOf(const Geometry& g, const Vector3d& wrist) {
  const RawReach raw = rawReach(g, wrist);
  return {std::sqrt(std::max(0.0, raw.horizontal2)), wrist.z() - g.base_height,
          std::clamp(raw.cos_elbow, -1.0, 1.0)};
}

/// Joints 1 to 3 for one shoulder and elbow.
void placeWrist(const Geometry& g, const Vector3d& wrist, const Reach& reach,
                InverseSolution& solution) {
  const double rr = solution.shoulder == Shoulder::kFront ? reach.horizontal : -reach.horizontal;
  const double elbow = std::acos(reach.cos_elbow);
  const double q3 = solution.elbow == Elbow::kPositive ? elbow : -elbow;
  solution.q(0) = wrapped(std::atan2(wrist.y(), wrist.x()) - std::atan2(g.shoulder_offset, rr));
  solution.q(1) =
      wrapped(std::atan2(rr, reach.height) -
              std::atan2(g.forearm * std::sin(q3), g.upper_arm + g.forearm * reach.cos_elbow));
  solution.q(2) = q3;
}

/// Joints 4 to 6 for one wrist: fR3' = Rz(q1) Ry(q2 + q3), then Z-Y-Z. Joint 6 is taken from joint
/// 4 and not from the third row, so that both together stay exact however small sin q5 is.
void turnWrist(const Matrix3d& fRe, InverseSolution& solution) {
  const double q1 = solution.q(0);
  const double q23 = solution.q(1) + solution.q(2);
  const Matrix3d r =
      (Eigen::AngleAxisd(q1, Vector3d::UnitZ()) * Eigen::AngleAxisd(q23, Vector3d::UnitY()))
          .toRotationMatrix()
          .transpose() *
      fRe;
  const double sine = std::hypot(r(0, 2), r(1, 2));
  const double sign = solution.wrist == Wrist::kPositive ? 1.0 : -1.0;
  solution.wrist_singular = sine < kSingularWrist;
  const double q4 = solution.wrist_singular ? 0.0 : std::atan2(sign * r(1, 2), sign * r(0, 2));
  const double s4 = std::sin(q4);
  const double c4 = std::cos(q4);
  solution.q(3) = q4;
  solution.q(4) = sign * std::atan2(sine, r(2, 2));
  solution.q(5) = std::atan2(c4 * r(1, 0) - s4 * r(0, 0), c4 * r(1, 1) - s4 * r(0, 1));
}

/// How far q leaves the limits: the worst joint and by how much [rad]; 0 within.
struct Excess {
  int joint = 0;
  double angle = 0.0;
};

Excess excessOf(const JointVector& q, const JointLimits& limits) {
  Excess worst;
  const JointVector over = (q - limits.upper).cwiseMax(limits.lower - q);
  worst.angle = over.maxCoeff(&worst.joint);
  return worst.angle > kLimitRounding ? worst : Excess{};
}

/// Values of q + full turns within [lower, upper].
std::vector<double> turnsWithin(double q, double lower, double upper) {
  std::vector<double> values;
  const double turn = 2.0 * kPi;
  const double first = std::ceil((lower - kLimitRounding - q) / turn);
  const double last = std::floor((upper + kLimitRounding - q) / turn);
  for (double k = first; k <= last; k += 1.0) {
    values.push_back(std::clamp(q + k * turn, lower, upper));
  }
  return values;
}

/// A singular wrist leaves the split of q4 + q6 open: keep joint 4 where it is.
JointVector keepJoint4(const InverseSolution& solution, const JointLimits& limits,
                       const JointVector& q_reference) {
  JointVector q = solution.q;
  if (solution.wrist_singular) {
    const double q4 = std::clamp(q_reference(3), limits.lower(3), limits.upper(3));
    // With q5 = pi the two axes oppose each other and the difference counts.
    const double side = std::cos(q(4)) > 0.0 ? 1.0 : -1.0;
    q(5) = wrapped(q(5) + side * (q(3) - q4));
    q(3) = q4;
  }
  return q;
}

Refusal limitsBroken(const Excess& least) {
  char text[120];
  std::snprintf(text, sizeof text,
                "outside the joint limits: the best branch exceeds J%d by %.1f deg",
                least.joint + 1, least.angle / kDegree);
  return {text};
}

/// All distinct branches. Precondition: reachable.
InverseSolutions branches(const Geometry& geometry, const Pose& fMe) {
  const Vector3d wrist = wristCentre(geometry, fMe);
  const Reach reach = reachOf(geometry, wrist);
  const bool stretched = std::abs(reach.cos_elbow) == 1.0;
  InverseSolutions solutions;
  solutions.reserve(8);
  for (int branch = 0; branch < 8; ++branch) {
    InverseSolution solution;
    solution.shoulder = (branch & 4) == 0 ? Shoulder::kFront : Shoulder::kBack;
    solution.elbow = (branch & 2) == 0 ? Elbow::kPositive : Elbow::kNegative;
    solution.wrist = (branch & 1) == 0 ? Wrist::kPositive : Wrist::kNegative;
    placeWrist(geometry, wrist, reach, solution);
    turnWrist(fMe.linear(), solution);
    const bool same_elbow = stretched && solution.elbow == Elbow::kNegative;
    const bool same_wrist = solution.wrist_singular && solution.wrist == Wrist::kNegative;
    if (!same_elbow && !same_wrist) {
      solution.q = (solution.q - geometry.zero).unaryExpr(&wrapped);
      solutions.push_back(solution);
    }
  }
  return solutions;
}

}  // namespace

Outcome<InverseSolutions> inverse(const Geometry& geometry, const Pose& fMe) {
  if (const std::optional<Refusal> refusal = unreachable(geometry, fMe)) {
    return *refusal;
  }
  return branches(geometry, fMe);
}

std::vector<JointVector> expandTurns(const JointVector& q, const JointLimits& limits) {
  std::vector<JointVector> expanded;
  for (const double q4 : turnsWithin(q(3), limits.lower(3), limits.upper(3))) {
    for (const double q6 : turnsWithin(q(5), limits.lower(5), limits.upper(5))) {
      JointVector candidate = q;
      candidate(3) = q4;
      candidate(5) = q6;
      if (excessOf(candidate, limits).angle == 0.0) {
        expanded.emplace_back(candidate.cwiseMax(limits.lower).cwiseMin(limits.upper));
      }
    }
  }
  return expanded;
}

Outcome<JointVector> nearestInverse(const Geometry& geometry, const JointLimits& limits,
                                    const Pose& fMe, const JointVector& q_reference) {
  if (const std::optional<Refusal> refusal = unreachable(geometry, fMe)) {
    return *refusal;
  }
  if (!q_reference.allFinite()) {
    return Refusal{"reference joints are not finite"};
  }
  std::optional<JointVector> nearest;
  double least_cost = std::numeric_limits<double>::infinity();
  Excess least_excess{0, least_cost};
  for (const InverseSolution& solution : branches(geometry, fMe)) {
    const JointVector q = keepJoint4(solution, limits, q_reference);
    const Excess excess = excessOf(q, limits);
    least_excess = excess.angle < least_excess.angle ? excess : least_excess;
    for (const JointVector& candidate : expandTurns(q, limits)) {
      const double cost = (candidate - q_reference).cwiseQuotient(limits.velocity).squaredNorm();
      if (cost < least_cost) {
        least_cost = cost;
        nearest = candidate;
      }
    }
  }
  if (!nearest) {
    return limitsBroken(least_excess);
  }
  return *nearest;
}

}  // namespace ringhook::rx60
