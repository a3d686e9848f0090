#include "cycle/back_off.h"

namespace ringhook {
namespace {

PathLeg leg(const Pose& oMr_start, const Eigen::Vector3d& motion_o, double speed) {
  PathLeg straight;
  straight.oMr_start = oMr_start;
  straight.oMr_end = oMr_start;
  straight.oMr_end.translation() += motion_o;
  straight.duration_s = 2.0 * motion_o.norm() / speed;
  return straight;
}

}  // namespace

RingPath planBackOff(const Pose& oMr_start, const InsertionParameters& parameters) {
  RingPath path;
  Pose oMr = oMr_start;
  const double rise = parameters.tip_o.z() + parameters.hover_height - oMr_start.translation().z();
  if (rise > 0.0) {
    path.push_back(leg(oMr, rise * Eigen::Vector3d::UnitZ(), parameters.lower.linear));
    oMr = path.back().oMr_end;
  }
  path.push_back(leg(oMr, parameters.standoff_offset_o, parameters.approach.linear));
  return path;
}

}  // namespace ringhook
