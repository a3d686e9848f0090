#include "evaluation/trajectory_result.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/number_text.h"
#include "evaluation/sample_noise.h"
#include "evaluation/trajectory_models.h"

namespace ringhook {
namespace {

void requirePositive(const std::optional<double>& value, const std::string& option,
                     const std::string& unit) {
  if (value && !(*value > 0.0 && std::isfinite(*value))) {
    throw InputError(option + ": expected a number above 0 [" + unit + "], found " +
                     exactText(*value));
  }
}

void checkOptions(const Trajectory& trajectory, const TrajectoryEvaluationOptions& options) {
  const double duration = trajectory.times.back() - trajectory.times.front();
  const auto& horizons = options.horizons_s;
  if (horizons.empty()) {
    throw InputError("--horizons: expected at least one number of seconds");
  }
  for (const double horizon : horizons) {
    requirePositive(horizon, "--horizons", "s");
    if (horizon >= duration) {
      throw InputError("--horizons " + exactText(horizon) + ": expected less than the " +
                       exactText(duration) + " s that " + trajectory.name + " lasts");
    }
    if (std::count(horizons.begin(), horizons.end(), horizon) > 1) {
      throw InputError("--horizons: expected each number once, found " + exactText(horizon) +
                       " again");
    }
  }
  requirePositive(options.noise, "--noise", isAngular(trajectory.kind) ? "rad" : "m");
  requirePositive(options.length_m, "--length", "m");
  if (!(options.warm_up_s >= 0.0 && options.warm_up_s < duration)) {
    throw InputError("--warm-up " + exactText(options.warm_up_s) + ": expected at least 0 and " +
                     "less than the " + exactText(duration) + " s that " + trajectory.name +
                     " lasts");
  }
}

/// As in "noise densities chosen in hindsight: 0.1, 1000, 1".
std::string chosenNoise(const std::vector<double>& densities) {
  std::string text;
  for (const double density : densities) {
    char number[32];
    std::snprintf(number, sizeof(number), "%.3g", density);
    text += (text.empty() ? "noise densities chosen in hindsight: " : ", ") + std::string(number);
  }
  return text;
}

}  // namespace

TrajectoryResult evaluateTrajectory(const Trajectory& trajectory,
                                    const TrajectoryEvaluationOptions& options) {
  checkOptions(trajectory, options);
  const auto names = chosenModels(options.models);
  TrajectoryResult result;
  result.repeated = repeatedSamples(trajectory);
  result.trajectory = isAngular(trajectory.kind) ? trajectory : withoutRepeated(trajectory);
  const Trajectory& judge = result.trajectory;
  if (judge.values.size() < 2) {
    throw InputError(trajectory.name + " never moves: expected samples that differ");
  }
  result.noise_estimated = !options.noise.has_value();
  result.noise = options.noise ? *options.noise : estimateSampleNoise(judge);
  result.step_s = medianStep(judge);
  for (const double horizon : options.horizons_s) {
    result.truth.push_back(truthAhead(judge, horizon));
  }
  const ModelSettings settings{result.noise, options.length_m, 0.0};
  for (const auto& name : names) {
    const TunedModel tuned = makeTunedModel(name, judge, result.truth, settings, options.warm_up_s);
    result.runs.push_back(runModel(*tuned.model, judge, result.truth));
    std::string& note = result.runs.back().note;
    note += (note.empty() || tuned.densities.empty() ? "" : "; ") + chosenNoise(tuned.densities);
  }
  const std::size_t first = firstJudged(judge, result.runs, options.warm_up_s);
  result.judged_from_s = judge.times[std::min(first, judge.times.size() - 1)] - judge.times.front();
  result.summaries = summariseRuns(judge, result.truth, result.runs, options.warm_up_s);
  return result;
}

}  // namespace ringhook
