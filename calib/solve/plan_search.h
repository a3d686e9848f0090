#pragma once

/// \file
/// The baseline and vergence to build for a wanted accuracy. A longer baseline lowers the error in
/// depth (up to twice the distance), but parts the two views: surfaces are seen from two sides,
/// matching gets harder, and the field that both cameras see shrinks (the 2007 report (Jeyabalan,
/// Fork project), section 2.5). Hence the shortest baseline is looked for whose worst error in the
/// workspace is what is wanted. The vergence hardly changes the error, but decides what is seen: it
/// is the one that leaves most room between the workspace's images and the image borders.

#include <Eigen/Core>
#include <optional>

#include "calib/solve/plan.h"
#include "core/outcome.h"

namespace ringhook {

/// A box in frame m, axes parallel to it.
struct WorkBox {
  Eigen::Vector3d centre_m{0, 0, 1};  ///< [m]
  Eigen::Vector3d size_m{0, 0, 0};    ///< full lengths [m]
};

/// Expected error of points in a box: square root of the covariance's trace.
struct BoxError {
  double worst_m = 0.0;  ///< over a grid of 5x5x5 points with the corners [m]
  double rms_m = 0.0;    ///< over the same points [m]
  double room_px = 0.0;  ///< least distance of an image of the box from a border [px]; may be < 0
};

/// Precondition for worst and rms to be meant: room_px >= 0; else they are infinite.
BoxError boxError(const PlanView& view, const WorkBox& box, double sigma_px);

struct PlanWish {
  PlannedSensor sensor;
  WorkBox box;
  double sigma_px = 0.1;        ///< per pixel axis [px]
  double max_baseline_m = 1.0;  ///< [m]
  double wanted_m = 0.0;        ///< worst error allowed in the box [m]; 0: as small as can be
};

struct PlanChoice {
  PlannedSetup setup;
  BoxError error;
};

struct PlanAdvice {
  std::optional<PlanChoice> shortest;  ///< that fulfils the wish; absent: none does
  PlanChoice finest;                   ///< least worst error of all allowed
};

/// Refuses, with a reason, if no allowed baseline shows the whole box to both cameras.
Outcome<PlanAdvice> adviseSetup(const PlanWish& wish);

}  // namespace ringhook
