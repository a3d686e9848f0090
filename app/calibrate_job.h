#pragma once

/// \file
/// What the steps of `ringhook calibrate` have in common.

#include <string>

#include "app/progress.h"
#include "calib/solve/stereo_problem.h"

namespace ringhook {

/// A hook that shows progress and, between steps, throws Interrupted when the operator asks for
/// it. `progress` must outlive the hook.
StepHook hookFor(Progress& progress);

/// Now, as in 2026-11-22T15:04:05Z: the date of a result.
std::string utcDate();

}  // namespace ringhook
