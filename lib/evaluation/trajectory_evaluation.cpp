#include "evaluation/trajectory_evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "prediction/chi_square.h"

namespace ringhook {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Eigen::Index column(std::size_t sample) { return static_cast<Eigen::Index>(sample); }

bool predictsAt(const ModelRun& run, std::size_t sample) {
  return std::any_of(run.errors.begin(), run.errors.end(), [sample](const auto& errors) {
    return errors.col(column(sample)).allFinite();
  });
}

std::optional<std::size_t> firstPrediction(const ModelRun& run, std::size_t samples) {
  for (std::size_t i = 0; i < samples; ++i) {
    if (predictsAt(run, i)) {
      return i;
    }
  }
  return std::nullopt;
}

/// Samples after which every predicting model said something that can be judged.
std::vector<std::size_t> judgedSamples(const std::vector<ModelRun>& runs, std::size_t horizon,
                                       std::size_t first, std::size_t samples) {
  std::vector<const Eigen::MatrixXd*> errors;
  for (const ModelRun& run : runs) {
    if (firstPrediction(run, samples)) {
      errors.push_back(&run.errors[horizon]);
    }
  }
  std::vector<std::size_t> judged;
  for (std::size_t i = first; i < samples && !errors.empty(); ++i) {
    const bool all = std::all_of(errors.begin(), errors.end(), [i](const Eigen::MatrixXd* one) {
      return one->col(column(i)).allFinite();
    });
    if (all) {
      judged.push_back(i);
    }
  }
  return judged;
}

HorizonResult judge(const Eigen::MatrixXd& errors, const std::vector<std::size_t>& judged,
                    double horizon_s, bool point) {
  HorizonResult result;
  result.horizon_s = horizon_s;
  result.samples = judged.size();
  double sum = 0.0;
  double horizontal = 0.0;
  for (const std::size_t i : judged) {
    sum += errors.col(column(i)).squaredNorm();
    horizontal +=
        errors.col(column(i)).head(std::min<Eigen::Index>(2, errors.rows())).squaredNorm();
  }
  const auto count = static_cast<double>(judged.size());
  result.rms = judged.empty() ? kNone : std::sqrt(sum / count / static_cast<double>(errors.rows()));
  if (point) {
    result.horizontal_rms = judged.empty() ? kNone : std::sqrt(horizontal / count);
  }
  return result;
}

void judgeConsistency(const ModelRun& run, std::size_t first, ModelSummary& summary) {
  constexpr double kTail = 0.025;
  double sum = 0.0;
  std::size_t inside = 0;
  std::size_t count = 0;
  double low = 0.0;
  double high = 0.0;
  for (std::size_t i = first; i < run.updates.size(); ++i) {
    const FilterUpdate& update = run.updates[i];
    if (update.degrees == 0) {
      continue;
    }
    if (update.degrees != summary.nis_degrees) {
      summary.nis_degrees = update.degrees;
      low = chiSquareQuantile(kTail, update.degrees);
      high = chiSquareQuantile(1.0 - kTail, update.degrees);
    }
    sum += update.nis;
    inside += update.nis >= low && update.nis <= high ? 1 : 0;
    ++count;
  }
  summary.nis_mean = count > 0 ? sum / static_cast<double>(count) : kNone;
  summary.nis_inside_95 =
      count > 0 ? static_cast<double>(inside) / static_cast<double>(count) : kNone;
}

}  // namespace

HorizonTruth truthAhead(const Trajectory& trajectory, double horizon_s) {
  const auto& times = trajectory.times;
  const double gap = 5.0 * medianStep(trajectory);
  const Eigen::Index size = predictedSize(trajectory.kind);
  HorizonTruth truth{horizon_s, Eigen::MatrixXd::Constant(size, column(times.size()), kNone)};
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Time then = times[i] + horizon_s;
    const auto after = std::lower_bound(times.begin(), times.end(), then);
    if (after == times.end()) {
      break;
    }
    const auto b = static_cast<std::size_t>(after - times.begin());
    const std::size_t a = *after == then ? b : b - 1;
    const double between = times[b] - times[a];
    if (between > gap) {
      continue;
    }
    const double share = a == b ? 0.0 : (then - times[a]) / between;
    truth.ahead.col(column(i)) =
        (1.0 - share) * trajectory.values[a].head(size) + share * trajectory.values[b].head(size);
  }
  return truth;
}

ModelRun runModel(MotionModel& model, const Trajectory& trajectory,
                  const std::vector<HorizonTruth>& truth, std::size_t stride) {
  ModelRun run;
  run.name = model.name();
  for (const HorizonTruth& one : truth) {
    run.errors.emplace_back(Eigen::MatrixXd::Constant(one.ahead.rows(), one.ahead.cols(), kNone));
  }
  for (std::size_t i = 0; i < trajectory.times.size(); ++i) {
    const Time now = trajectory.times[i];
    const auto update = model.update(now, trajectory.values[i]);
    run.refused += update ? 0 : 1;
    run.updates.push_back(update ? *update : FilterUpdate{now, 0.0, 0});
    if (i % stride != 0) {
      continue;
    }
    run.parameters.resize(i + 1);
    run.parameters[i] = model.parameters();
    for (std::size_t h = 0; h < truth.size(); ++h) {
      const auto then = model.predict(now + truth[h].horizon_s);
      if (then) {
        run.errors[h].col(column(i)) = then->mean - truth[h].ahead.col(column(i));
      }
    }
  }
  run.note = model.note();
  return run;
}

std::size_t firstJudged(const Trajectory& trajectory, const std::vector<ModelRun>& runs,
                        double warm_up_s) {
  const auto& times = trajectory.times;
  const auto warm = std::lower_bound(times.begin(), times.end(), times.front() + warm_up_s);
  auto first = static_cast<std::size_t>(warm - times.begin());
  for (const ModelRun& run : runs) {
    first = std::max(first, firstPrediction(run, times.size()).value_or(0));
  }
  return first;
}

std::vector<ModelSummary> summariseRuns(const Trajectory& trajectory,
                                        const std::vector<HorizonTruth>& truth,
                                        const std::vector<ModelRun>& runs, double warm_up_s) {
  const std::size_t samples = trajectory.times.size();
  const std::size_t first = firstJudged(trajectory, runs, warm_up_s);
  std::vector<ModelSummary> summaries;
  for (const ModelRun& run : runs) {
    ModelSummary summary;
    summary.name = run.name;
    summary.predicts = firstPrediction(run, samples).has_value();
    summary.parameters = run.parameters.back();
    summary.refused = run.refused;
    const bool late = !summary.predicts && !summary.parameters.empty();
    summary.note = late ? "began too late to be judged" : run.note;
    summaries.push_back(std::move(summary));
    judgeConsistency(run, first, summaries.back());
  }
  for (std::size_t h = 0; h < truth.size(); ++h) {
    const auto judged = judgedSamples(runs, h, first, samples);
    for (std::size_t m = 0; m < runs.size(); ++m) {
      if (summaries[m].predicts) {
        summaries[m].horizons.push_back(
            judge(runs[m].errors[h], judged, truth[h].horizon_s, !isAngular(trajectory.kind)));
      }
    }
  }
  return summaries;
}

}  // namespace ringhook
