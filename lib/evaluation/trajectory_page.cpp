#include "evaluation/trajectory_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/number_text.h"

namespace ringhook {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return std::isfinite(value) ? text : "–";
}

const char* unitOf(const TrajectoryResult& result) {
  return isAngular(result.trajectory.kind) ? "mrad" : "mm";
}

std::vector<double> timesOf(const TrajectoryResult& result) {
  std::vector<double> times;
  for (const Time time : result.trajectory.times) {
    times.push_back(time.seconds());
  }
  return times;
}

/// One line a model.
ReportChart errorChart(const TrajectoryResult& result) {
  const std::size_t middle = result.truth.size() / 2;
  const double horizon = result.truth[middle].horizon_s;
  ReportChart chart{
      "size of the error, predicted " + exactText(horizon) + " s before [" + unitOf(result) + "]",
      {},
      timesOf(result),
      {}};
  for (double& time : chart.time_s) {
    time += horizon;
  }
  for (const ModelRun& run : result.runs) {
    chart.series.push_back(run.name);
    chart.values.emplace_back();
    for (const auto& error : run.errors[middle].colwise()) {
      chart.values.back().push_back(1e3 * error.norm());
    }
  }
  return chart;
}

/// The chart's axis is the horizon; models that never predict have no line.
ReportChart horizonChart(const TrajectoryResult& result) {
  ReportChart chart{
      std::string("RMS [") + unitOf(result) + "] by horizon; time is the horizon", {}, {}, {}};
  std::vector<std::size_t> order(result.truth.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  std::sort(order.begin(), order.end(), [&result](std::size_t a, std::size_t b) {
    return result.truth[a].horizon_s < result.truth[b].horizon_s;
  });
  for (const std::size_t i : order) {
    chart.time_s.push_back(result.truth[i].horizon_s);
  }
  for (const ModelSummary& summary : result.summaries) {
    if (!summary.predicts) {
      continue;
    }
    chart.series.push_back(summary.name);
    chart.values.emplace_back();
    for (const std::size_t i : order) {
      chart.values.back().push_back(1e3 * summary.horizons[i].rms);
    }
  }
  return chart;
}

/// A parameter of one model, with one standard deviation on both sides.
ReportChart parameterChart(const TrajectoryResult& result, std::size_t model, std::size_t which) {
  const ModelRun& run = result.runs[model];
  ReportChart chart{run.name + ": " + run.parameters.back()[which].key,
                    {"value", "one deviation above", "one deviation below"},
                    timesOf(result),
                    std::vector<std::vector<double>>(3)};
  for (const auto& parameters : run.parameters) {
    const bool known = which < parameters.size();
    const double value = known ? parameters[which].value : kNone;
    const double sigma = known ? parameters[which].sigma : kNone;
    chart.values[0].push_back(value);
    chart.values[1].push_back(value + sigma);
    chart.values[2].push_back(value - sigma);
  }
  return chart;
}

std::vector<std::vector<std::string>> tableOf(const TrajectoryResult& result) {
  std::vector<std::string> head = {"model"};
  for (const HorizonTruth& one : result.truth) {
    head.push_back("RMS at " + exactText(one.horizon_s) + " s [" + unitOf(result) + "]");
  }
  const std::vector<std::string> rest = {"NIS mean", "of", "inside its 95 % band [%]", "note"};
  head.insert(head.end(), rest.begin(), rest.end());
  std::vector<std::vector<std::string>> table = {head};
  for (const ModelSummary& summary : result.summaries) {
    std::vector<std::string> row = {summary.name};
    for (std::size_t i = 0; i < result.truth.size(); ++i) {
      row.push_back(summary.predicts ? shortNumber(1e3 * summary.horizons[i].rms) : "–");
    }
    row.insert(row.end(), {shortNumber(summary.nis_mean), std::to_string(summary.nis_degrees),
                           shortNumber(100.0 * summary.nis_inside_95), summary.note});
    table.push_back(std::move(row));
  }
  return table;
}

}  // namespace

ReportPage trajectoryPage(const TrajectoryResult& result) {
  const double scale = 1e3;
  ReportPage page;
  page.title = "Trajectory " + result.trajectory.name;
  page.facts = {
      {"samples", std::to_string(result.trajectory.times.size()) + " at " +
                      shortNumber(1.0 / result.step_s) + " Hz"},
      {"repeated samples", std::to_string(result.repeated)},
      {"measurement noise", shortNumber(scale * result.noise) + " " + unitOf(result) +
                                (result.noise_estimated ? ", estimated from the data" : "")},
      {"judged", "from " + shortNumber(result.judged_from_s) + " s on, all models alike"}};
  page.table = tableOf(result);
  page.charts = {errorChart(result), horizonChart(result)};
  for (std::size_t m = 0; m < result.runs.size(); ++m) {
    for (std::size_t i = 0; i < result.runs[m].parameters.back().size(); ++i) {
      page.charts.push_back(parameterChart(result, m, i));
    }
  }
  return page;
}

}  // namespace ringhook
