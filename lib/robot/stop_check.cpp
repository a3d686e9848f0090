#include "robot/stop_check.h"

#include <algorithm>
#include <cmath>

namespace ringhook {
namespace {

constexpr int kLongestStop = 2000;           // periods
constexpr double kStillSpeed = 1e-11;        // [rad/s]
constexpr double kStillAcceleration = 1e-8;  // [rad/s^2]

JointVector velocityOf(const JointRates& rates) {
  JointVector velocity;
  for (int i = 0; i < 6; ++i) {
    velocity(i) = rates[static_cast<std::size_t>(i)].velocity;
  }
  return velocity;
}

bool still(const JointRates& rates) {
  return std::ranges::all_of(rates, [](const JointRate& rate) {
    return std::abs(rate.velocity) < kStillSpeed &&
           std::abs(rate.acceleration) < kStillAcceleration;
  });
}

bool boxed(const WorkspaceBox& box) {
  return box.lower.array().isFinite().any() || box.upper.array().isFinite().any();
}

/// So slow that neither tool speed nor singularity can matter, wherever the arm is: no joint moves
/// the tool by more than its speed times the stretched length of the arm beyond it.
bool surelySlow(const StopBounds& b, const JointVector& velocity) {
  const double hand = b.geometry.flange + b.tool_e.norm();
  const double fore = b.geometry.forearm + hand;
  const double arm = b.geometry.upper_arm + b.geometry.shoulder_offset + fore;
  JointVector reach;
  reach << arm, arm, fore, hand, hand, hand;
  return reach.dot(velocity.cwiseAbs()) < b.tool_speed && b.speedRatio(velocity) < b.least_share;
}

BrokenLimit speedBroken(const StopBounds& bounds, const rx60::ToolPoint& tool,
                        const JointVector& velocity) {
  if ((tool.fJ * velocity).squaredNorm() > bounds.tool_speed * bounds.tool_speed) {
    return BrokenLimit::kToolSpeed;
  }
  return bounds.speedRatio(velocity) > bounds.share(tool.manipulability) ? BrokenLimit::kSingular
                                                                         : BrokenLimit::kNone;
}

bool outside(const WorkspaceBox& box, const Eigen::Vector3d& position) {
  return (position.array() > box.upper.array()).any() ||
         (position.array() < box.lower.array()).any();
}

/// Whether the way from one place to the next leads out of the box, or further out of it.
bool leaves(const WorkspaceBox& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return outside({box.lower.cwiseMin(from), box.upper.cwiseMax(from)}, to);
}

/// The same for the positions of the joints; `moved` is their way since `place` [rad].
bool leaves(const StopBounds& bounds, const JointPlace& place, const JointVector& moved,
            const JointVector& velocity) {
  return ((place.high + moved - bounds.upper).array() > 0.0 && velocity.array() > kStillSpeed)
             .any() ||
         ((place.low + moved - bounds.lower).array() < 0.0 && velocity.array() < -kStillSpeed)
             .any();
}

/// What the tool breaks in a period from `before` to `after` at one velocity.
BrokenLimit toolBroken(const StopBounds& bounds, const JointVector& before,
                       const JointVector& after, const JointVector& velocity) {
  const bool slow = surelySlow(bounds, velocity);
  const rx60::ToolPoint to = rx60::toolPoint(bounds.geometry, bounds.tool_e, after);
  if (slow && !outside(bounds.box, to.position)) {
    return BrokenLimit::kNone;
  }
  const rx60::ToolPoint from = rx60::toolPoint(bounds.geometry, bounds.tool_e, before);
  if (leaves(bounds.box, from.position, to.position)) {
    return BrokenLimit::kWorkspace;
  }
  const BrokenLimit broken = speedBroken(bounds, to, velocity);
  return broken != BrokenLimit::kNone ? broken : speedBroken(bounds, from, velocity);
}

}  // namespace

double StopBounds::share(double manipulability) const {
  const double ratio = std::min(1.0, manipulability / singular_below);
  return least_share + (1.0 - least_share) * ratio;
}

double StopBounds::speedRatio(const JointVector& velocity) const {
  double ratio = 0.0;
  for (int i = 0; i < 6; ++i) {
    const double bound = joints[static_cast<std::size_t>(i)].velocity;
    ratio = std::max(ratio, std::abs(velocity(i)) / bound);
  }
  return ratio;
}

BrokenLimit firstBroken(const StopBounds& bounds, const JointPlace& place, JointRates rates) {
  const double period = bounds.joints[0].period_s;
  const bool has_box = boxed(bounds.box);
  JointVector moved = JointVector::Zero();
  for (int k = 0; k < kLongestStop; ++k) {
    const JointVector velocity = velocityOf(rates);
    const JointVector before = moved;
    moved += period * velocity;
    if (leaves(bounds, place, moved, velocity)) {
      return BrokenLimit::kPosition;
    }
    if (has_box || !surelySlow(bounds, velocity)) {
      const BrokenLimit broken =
          toolBroken(bounds, place.estimate + before, place.estimate + moved, velocity);
      if (broken != BrokenLimit::kNone) {
        return broken;
      }
    }
    if (still(rates)) {
      return BrokenLimit::kNone;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      rates[i] = brakingStep(rates[i], bounds.joints[i]);
    }
  }
  return BrokenLimit::kPosition;
}

}  // namespace ringhook
