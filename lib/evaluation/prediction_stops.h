#pragma once

/// \file
/// Parts of the prediction experiment: belts that stop while a hook is followed, whether the
/// filter's innovations are what it says of them, and what could be known afterwards.

#include <functional>

#include "evaluation/prediction_experiment.h"

namespace ringhook {

/// The belt stops after 4 s. \param poses seen, else points of which nothing is known.
StopResult stopRuns(bool poses, int seeds, const std::function<void(double)>& progress);

/// Mean NIS of 3.5 s of poses, run by run, against its chi-square band. `step` begins every run.
ConsistencyResult consistencyRuns(int seeds, const std::function<void()>& step);

/// Four seconds of poses; judged between the first second and the third. `step` as above.
SmootherResult smootherRuns(int seeds, const std::function<void()>& step);

}  // namespace ringhook
