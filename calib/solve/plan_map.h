#pragma once

/// \file
/// A plan drawn up: expected errors across the stereo field at the working distance and along the
/// middle over the distance (the two plots of figure 2.10 of the 2007 report (Jeyabalan, Fork
/// project)), what both cameras see, as table and as picture.

#include <optional>
#include <string>
#include <vector>

#include "calib/solve/plan.h"
#include "calib/solve/plan_search.h"

namespace ringhook {

/// Expected error of one point.
struct PlanPoint {
  Eigen::Vector3d point_m;   ///< in frame m [m]
  Eigen::Vector2d left_px;   ///< where the left camera sees it [px]
  Eigen::Vector2d right_px;  ///< where the right camera sees it [px]
  Eigen::Vector3d sigma_m;   ///< standard deviation along x, y, z of frame m [m]
  double total_m = 0.0;      ///< square root of the covariance's trace [m]
};

/// The same of a square tag that faces the cameras there.
struct TagError {
  double position_m = 0.0;    ///< of its centre, square root of the trace [m]
  double rotation_rad = 0.0;  ///< likewise [rad]
};

struct PlanMap {
  double sigma_px = 0.0;              ///< noise per pixel axis [px]
  double distance_m = 0.0;            ///< working distance [m]
  StereoField field;                  ///< at the working distance
  std::optional<PlanPoint> middle;    ///< of the field at the working distance
  std::vector<PlanPoint> across;      ///< at the working distance, row by row, seen ones only
  double across_step_m = 0.0;         ///< between points of `across` [m]
  std::vector<PlanPoint> along;       ///< through the middle of the field at each distance
  std::vector<StereoField> fields;    ///< one for each of `along`
  std::optional<TagError> tag;        ///< in the middle, if a tag was asked for
  std::optional<WorkBox> box;         ///< as given
  std::optional<BoxError> box_error;  ///< of `box`
};

/// \param tag_size_m side of a tag [m], 0 for none.
PlanMap mapPlan(const PlanView& view, double sigma_px, double distance_m, double tag_size_m,
                const std::optional<WorkBox>& box);

/// plan.csv: one row a point, sections field and distance.
std::string planTable(const PlanMap& map);

/// plan.svg: errors across the field, errors over the distance, and the cameras from above.
std::string planPicture(const PlanView& view, const PlanMap& map);

}  // namespace ringhook
