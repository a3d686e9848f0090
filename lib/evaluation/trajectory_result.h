#pragma once

/// \file
/// `ringhook evaluate trajectory` from a trajectory and options to everything that its outputs
/// show.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/trajectory_evaluation.h"

namespace ringhook {

struct TrajectoryEvaluationOptions {
  std::vector<std::string> models;                   ///< names; empty or "all": every known one
  std::vector<double> horizons_s = {0.1, 0.2, 0.5};  ///< how far ahead is predicted [s]
  std::optional<double> noise;                       ///< measurement noise [rad or m]; estimated
  std::optional<double> length_m;                    ///< of the linear pendulums; found
  double warm_up_s = 1.0;                            ///< before predictions are judged
};

struct TrajectoryResult {
  Trajectory trajectory;     ///< as given to the models
  std::size_t repeated = 0;  ///< samples like the one before; left out of a trajectory of points
  double noise = 0.0;        ///< measurement noise [rad or m]
  bool noise_estimated = false;  ///< it was not told
  double step_s = 0.0;           ///< usual time between samples
  double judged_from_s = 0.0;    ///< after the first sample
  std::vector<HorizonTruth> truth;
  std::vector<ModelRun> runs;           ///< at least one; the first is the main one
  std::vector<ModelSummary> summaries;  ///< of the same
};

/// A point that repeats all of its numbers was not measured anew, but held by its source, and is
/// neither given to a model nor a judge; an angle may well be measured twice alike.
/// Throws InputError naming the option: a model that is not known, a horizon that is not above 0 or
/// is longer than the file, told twice, a noise or a length that is not above 0, a warm-up below 0
/// or longer than the file.
[[nodiscard]] TrajectoryResult evaluateTrajectory(const Trajectory& trajectory,
                                                  const TrajectoryEvaluationOptions& options);

}  // namespace ringhook
