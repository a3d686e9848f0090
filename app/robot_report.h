#pragma once

/// \file
/// What `ringhook calibrate robot` prints and writes as JSON.

#include <nlohmann/json.hpp>

#include "calib/solve/plate_views.h"
#include "calib/solve/point_fit.h"

namespace ringhook {

nlohmann::json summaryOf(const HandEyeResult& result);
nlohmann::json summaryOf(const PlateCalibration& calibration);
nlohmann::json summaryOf(const PointFit& fit, const std::vector<PointPair>& points);

void printResult(const HandEyeResult& result, const std::vector<PosePair>& pairs);
void printResult(const PlateCalibration& calibration);
void printResult(const PointFit& fit, const std::vector<PointPair>& points);

}  // namespace ringhook
