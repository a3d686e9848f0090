#pragma once

/// \file
/// The words of `ringhook calibrate plan`, checked, and the work that they ask for.

#include <optional>
#include <string>
#include <vector>

#include "calib/solve/plan_check.h"
#include "calib/solve/plan_map.h"
#include "calib/solve/plan_search.h"

namespace ringhook {

/// Options as given, in their own units.
struct PlanJob {
  std::string rig;
  std::string sensor = "2048x2048";
  std::optional<double> focal_px, lens_mm, pixel_um;
  std::optional<double> baseline_m, vergence_deg, distance_m;
  double noise_px = 0.1;
  std::string box;
  std::optional<double> wanted_mm, max_baseline_m, tag_mm;
  int check = 0;
  std::string out;
  std::string json;
};

struct PlanAnswer {
  std::optional<PlanAdvice> advice;  ///< if an accuracy was wanted
  std::optional<PlanView> view;      ///< the rig that is mapped; always there
  PlanMap map;
  std::vector<CheckedPoint> checked;  ///< empty unless asked for
};

/// Throws InputError, one sentence that names the option and what was expected.
PlanAnswer answerPlan(const PlanJob& job);

}  // namespace ringhook
