#include "servo/insertion_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "core/error.h"
#include "servo/quintic.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;

void requirePositive(double value, const std::string& name) {
  if (!(std::isfinite(value) && value > 0.0)) {
    throw InputError("insertion path: " + name + " must be positive and finite");
  }
}

void requireSpeed(const PathSpeed& speed, const std::string& phase) {
  requirePositive(speed.linear, phase + " linear speed");
  requirePositive(speed.angular, phase + " angular speed");
  requirePositive(speed.acceleration, phase + " acceleration");
  requirePositive(speed.angular_acceleration, phase + " angular acceleration");
}

void requireFinite(const Vector3d& point, const std::string& name) {
  if (!point.allFinite()) {
    throw InputError("insertion path: " + name + " must be finite");
  }
}

void check(const InsertionParameters& p) {
  requireSpeed(p.approach, "approach");
  requireSpeed(p.align, "align");
  requireSpeed(p.lower, "lower");
  requireSpeed(p.retreat, "retreat");
  requirePositive(p.hover_height, "hover height");
  requirePositive(p.clearance, "clearance");
  requirePositive(p.hold_s, "hold time");
  requireFinite(p.tip_o, "tip");
  requireFinite(p.standoff_offset_o, "standoff offset");
  requireFinite(p.release_o, "release place");
  requireFinite(p.retreat_o, "retreat");
  if (p.standoff_offset_o.x() > -p.clearance) {
    throw InputError("insertion path: standoff must be at least the clearance beside the hook");
  }
}

PathLeg straightLeg(const Pose& from, const Pose& to, const PathSpeed& speed) {
  const double distance = (to.translation() - from.translation()).norm();
  const double angle = thetaU(from.linear().transpose() * to.linear()).norm();
  return {from, to,
          std::max(quinticDuration(distance, speed.linear, speed.acceleration),
                   quinticDuration(angle, speed.angular, speed.angular_acceleration))};
}

/// Adds the leg to `position`, orientation kept.
void shiftTo(const Vector3d& position, const PathSpeed& speed, Pose& oMr, RingPath& path) {
  Pose end = oMr;
  end.translation() = position;
  path.push_back(straightLeg(oMr, end, speed));
  oMr = end;
}

Pose parallelAt(const Vector3d& position) {
  Pose oMr = Pose::Identity();
  oMr.translation() = position;
  return oMr;
}

Vector3d hoverPoint(const InsertionParameters& p) {
  return p.tip_o + Vector3d(0.0, 0.0, p.hover_height);
}

RingPath planApproach(Pose oMr, const InsertionParameters& p) {
  RingPath path;
  // Round the hook on the tip's side: nothing of the hook lies beyond tip + clearance.
  const double y_clear = p.tip_o.y() + p.clearance;
  const Vector3d start = oMr.translation();
  if (start.x() > p.clearance && start.y() < y_clear) {
    shiftTo({start.x(), y_clear, start.z()}, p.approach, oMr, path);
  }
  if (oMr.translation().x() > -p.clearance) {
    const Vector3d beside = oMr.translation();
    shiftTo({-p.clearance, beside.y(), beside.z()}, p.approach, oMr, path);
  }
  const Vector3d standoff = hoverPoint(p) + p.standoff_offset_o;
  path.push_back(straightLeg(oMr, parallelAt(standoff), p.approach));
  return path;
}

}  // namespace

const char* phaseName(InsertionPhase phase) {
  switch (phase) {
    case InsertionPhase::kApproach:
      return "approach";
    case InsertionPhase::kAlign:
      return "align";
    case InsertionPhase::kLower:
      return "lower";
    case InsertionPhase::kHold:
      return "hold";
    case InsertionPhase::kRetreat:
      return "retreat";
  }
  return "unknown";
}

RingPath planPhase(InsertionPhase phase, const Pose& oMr_start, const InsertionParameters& p) {
  check(p);
  if (!oMr_start.matrix().allFinite()) {
    throw InputError("insertion path: start pose of the ring must be finite");
  }
  switch (phase) {
    case InsertionPhase::kApproach:
      return planApproach(oMr_start, p);
    case InsertionPhase::kAlign:
      return {straightLeg(oMr_start, parallelAt(hoverPoint(p)), p.align)};
    case InsertionPhase::kLower:
      return {straightLeg(oMr_start, parallelAt(p.release_o), p.lower)};
    case InsertionPhase::kHold:
      return {PathLeg{oMr_start, oMr_start, p.hold_s}};
    case InsertionPhase::kRetreat:
      break;
  }
  Pose end = oMr_start;
  end.translation() += p.retreat_o;
  return {straightLeg(oMr_start, end, p.retreat)};
}

double pathDuration(const RingPath& path) {
  double duration_s = 0.0;
  for (const PathLeg& leg : path) {
    duration_s += leg.duration_s;
  }
  return duration_s;
}

RingGoal samplePath(const RingPath& path, double s) {
  assert(!path.empty());
  std::size_t i = 0;
  while (i + 1 < path.size() && s >= path[i].duration_s) {
    s -= path[i].duration_s;
    ++i;
  }
  const PathLeg& leg = path[i];
  const QuinticSample at = quinticAt(s, leg.duration_s);
  const Vector3d way = leg.oMr_end.translation() - leg.oMr_start.translation();
  const Vector3d turn = thetaU(leg.oMr_start.linear().transpose() * leg.oMr_end.linear());
  RingGoal goal;
  goal.oMr = leg.oMr_start * makePoseThetaU(Vector3d::Zero(), at.progress * turn);
  goal.oMr.translation() = leg.oMr_start.translation() + at.progress * way;
  goal.twist_o << at.rate_per_s * way, at.rate_per_s * (leg.oMr_start.linear() * turn);
  return goal;
}

}  // namespace ringhook
