#pragma once

/// \file
/// What a stereo calibration found, for the terminal and for --json (keys: doc/formats.md).

#include <nlohmann/json.hpp>

#include "calib/solve/stereo_calibration.h"

namespace ringhook {

nlohmann::json summaryOf(const StereoCalibration& c);

/// Views, lens models, cameras with their standard deviations, verdict.
void printResult(const StereoCalibration& c, const Board& board);

}  // namespace ringhook
