#include <algorithm>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/number_text.h"
#include "evaluation/report_page.h"
#include "evaluation/tracking_experiment.h"

namespace ringhook {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e3;
constexpr const char* kStates[] = {"x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az"};
constexpr const char* kUnits[] = {"mm", "mm/s", "mm/s^2"};
constexpr const char* kViewKeys[] = {"plate_as_told", "plate_true_rig", "hook_as_told"};

/// Its tables 6.2 and 6.3 [mm; all nine: mm, mm/s, mm/s^2].
constexpr ErrorSpread kReportSeen[] = {{1.164, 0.186}, {3.194, 1.302}, {2.752, 0.867}};
constexpr ErrorSpread kReportSeenMean{2.370, 0.785};
constexpr ErrorSpread kReportDistance{0.637, 0.567};
constexpr ErrorSpread kReportPredicted{2.499, 1.243};
constexpr ErrorSpread kReportNine{1.117, 1.014};

/// Mean and deviation as cells; "-" twice for none.
void put(std::vector<std::string>& row, const std::optional<ErrorSpread>& spread) {
  for (const double ErrorSpread::*part : {&ErrorSpread::mean, &ErrorSpread::deviation}) {
    char text[32] = "-";
    if (spread) {
      std::snprintf(text, sizeof(text), "%.3f", (*spread).*part);
    }
    row.emplace_back(text);
  }
}

ErrorSpread positionOf(const std::array<ErrorSpread, 9>& states) {
  return meanOf(std::span(states).first<3>());
}

/// One-step error that the goal is about [mm].
double oneStep(const TrackingSequence& sequence, TrackingView view) {
  return positionOf(sequence.views[view].errors.by_acceleration).mean;
}

double meanOneStep(const TrackingExperiment& experiment, TrackingView view) {
  double mean = 0.0;
  for (const TrackingSequence& sequence : experiment.sequences) {
    mean += oneStep(sequence, view) / static_cast<double>(experiment.sequences.size());
  }
  return mean;
}

std::string stateName(std::size_t state) {
  return std::string(kStates[state]) + " [" + kUnits[state / 3] + "]";
}

/// Rows of name, then mean and deviation of the report and of our views.
class Rows {
 public:
  explicit Rows(const TrackingSequence& sequence) : sequence_(sequence) {
    rows_.push_back(
        {"absolute error, mean and std", "report", "", "plate", "", "true rig", "", "hook", ""});
  }
  template <class Value>
  void add(const std::string& name, const std::optional<ErrorSpread>& report, const Value& value) {
    std::vector<std::string> row{name};
    put(row, report);
    for (const TrackingCase& view : sequence_.views) {
      put(row, value(view.errors));
    }
    rows_.push_back(std::move(row));
  }
  [[nodiscard]] std::vector<std::vector<std::string>> take() { return std::move(rows_); }

 private:
  const TrackingSequence& sequence_;
  std::vector<std::vector<std::string>> rows_;
};

std::vector<std::vector<std::string>> rowsOf(const TrackingSequence& sequence) {
  using Errors = const TrackingErrors&;
  Rows rows(sequence);
  for (std::size_t i = 0; i < 3; ++i) {
    rows.add("stereo " + stateName(i), kReportSeen[i], [i](Errors e) { return e.seen[i]; });
  }
  rows.add("stereo, mean of x y z [mm]", kReportSeenMean, [](Errors e) { return meanOf(e.seen); });
  rows.add("stereo, step length [mm]", kReportDistance, [](Errors e) { return e.distance; });
  for (std::size_t i = 0; i < 9; ++i) {
    rows.add("predicted " + stateName(i), std::nullopt,
             [i](Errors e) { return e.by_acceleration[i]; });
  }
  rows.add("predicted, mean of x y z [mm]", kReportPredicted,
           [](Errors e) { return positionOf(e.by_acceleration); });
  rows.add("predicted, mean of all nine", kReportNine,
           [](Errors e) { return meanOf(e.by_acceleration); });
  rows.add("constant velocity, mean of x y z [mm]", std::nullopt,
           [](Errors e) { return positionOf(e.by_velocity); });
  rows.add("constant velocity, mean of all nine", std::nullopt,
           [](Errors e) { return meanOf(e.by_velocity); });
  return rows.take();
}

/// One line a fact, under the table and on the page.
std::vector<std::pair<std::string, std::string>> facts(const TrackingExperiment& experiment) {
  const TrackingSequence& first = experiment.sequences.front();
  std::string seeds;
  for (const TrackingSequence& sequence : experiment.sequences) {
    char text[64];
    std::snprintf(text, sizeof(text), "%s%.3f", seeds.empty() ? "" : ", ",
                  oneStep(sequence, kPlateAsTold));
    seeds += text;
  }
  char mean[160];
  std::snprintf(mean, sizeof(mean), "%.3f mm as told (goal %.1f), %.3f mm with the true rig",
                meanOneStep(experiment, kPlateAsTold), TrackingExperiment::kGoalMm,
                meanOneStep(experiment, kPlateTrueRig));
  char nis[64];
  std::snprintf(nis, sizeof(nis), "%.2f", first.views[kPlateAsTold].errors.nis);
  return {{"pictures", "simulated: 21 stereo pairs, 29.34 mm and one second apart, seed " +
                           std::to_string(first.seed)},
          {"plate", "centre of the tag plate against f, with the rig that the loop is told"},
          {"true rig", "the same without the error of the camera-robot calibration"},
          {"hook", "origin of the hook, 0.2 m below the plate, with the rig as told"},
          {"NIS per degree", nis},
          {"predicted, x y z, by seed [mm]", seeds},
          {"their mean", mean}};
}

Json spreadJson(const ErrorSpread& spread) {
  return {{"mean", spread.mean}, {"std", spread.deviation}};
}

Json predictedJson(const std::array<ErrorSpread, 9>& states) {
  Json json;
  constexpr const char* kSuffixes[] = {"_mm", "_mm_s", "_mm_s2"};
  for (std::size_t i = 0; i < states.size(); ++i) {
    json[std::string(kStates[i]) + kSuffixes[i / 3]] = spreadJson(states[i]);
  }
  json["position_mm"] = spreadJson(positionOf(states));
  json["nine_states"] = spreadJson(meanOf(states));
  return json;
}

Json errorsJson(const TrackingErrors& errors) {
  Json json;
  for (std::size_t i = 0; i < 3; ++i) {
    json["stereo"][std::string(kStates[i]) + "_mm"] = spreadJson(errors.seen[i]);
  }
  json["stereo"]["position_mm"] = spreadJson(meanOf(errors.seen));
  json["stereo"]["step_length_mm"] = spreadJson(errors.distance);
  json["constant_acceleration"] = predictedJson(errors.by_acceleration);
  json["constant_velocity"] = predictedJson(errors.by_velocity);
  json["nis_per_degree"] = errors.nis;
  return json;
}

std::string csvHead() {
  constexpr const char* kSuffixes[] = {"_m", "_m_s", "_m_s2"};
  std::string text = "seed,view,step,features";
  for (const std::string kind : {"true", "seen", "predicted", "predicted_cv"}) {
    for (std::size_t i = 0; i < (kind == "seen" ? 3U : 9U); ++i) {
      text += "," + kind + "_" + kStates[i] + kSuffixes[i / 3];
    }
  }
  return text + "\n";
}

std::string csvNumbers(const TrackingStep& step) {
  std::string text;
  const auto put9 = [&text](const std::optional<Vector9>& values) {
    for (int i = 0; i < 9; ++i) {
      text += "," + (values ? exactText((*values)(i)) : std::string());
    }
  };
  put9(step.truth);
  for (const double value : step.seen_f) {
    text += "," + exactText(value);
  }
  put9(step.by_acceleration);
  put9(step.by_velocity);
  return text;
}

std::string csv(const TrackingExperiment& experiment) {
  std::string text = csvHead();
  for (const TrackingSequence& sequence : experiment.sequences) {
    for (std::size_t view = 0; view < kTrackingViews; ++view) {
      const auto& steps = sequence.views[view].steps;
      for (std::size_t i = 0; i < steps.size(); ++i) {
        text += std::to_string(sequence.seed) + "," + kViewKeys[view] + "," + std::to_string(i) +
                "," + std::to_string(steps[i].features) + csvNumbers(steps[i]) + "\n";
      }
    }
  }
  return text;
}

/// One of the nine states over the steps, as in the report's figure 6.11.
ReportChart stateChart(const std::vector<TrackingStep>& steps, std::size_t state) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  const auto at = static_cast<Eigen::Index>(state);
  ReportChart chart{
      stateName(state), {"truth", "constant acceleration", "constant velocity"}, {}, {}};
  if (state < 3) {
    chart.series.emplace_back("stereo");
  }
  chart.values.resize(chart.series.size());
  for (const TrackingStep& step : steps) {
    chart.time_s.push_back(static_cast<double>(chart.time_s.size()));
    chart.values[0].push_back(kMilli * step.truth(at));
    chart.values[1].push_back(step.by_acceleration ? kMilli * (*step.by_acceleration)(at) : kGap);
    chart.values[2].push_back(step.by_velocity ? kMilli * (*step.by_velocity)(at) : kGap);
    if (state < 3) {
      chart.values[3].push_back(kMilli * step.seen_f(at));
    }
  }
  return chart;
}

ReportPage page(const TrackingExperiment& experiment) {
  const TrackingSequence& first = experiment.sequences.front();
  ReportPage page;
  page.title = "The precision of the 2007 report's prediction, on simulated pictures";
  page.facts = facts(experiment);
  page.facts.insert(page.facts.begin(),
                    {"source", "Jeyabalan, Fork project, section 6.3.1, tables 6.2 and 6.3"});
  page.table = rowsOf(first);
  for (std::size_t state = 0; state < 9; ++state) {
    page.charts.push_back(stateChart(first.views[kPlateAsTold].steps, state));
  }
  page.pictures = {{"first pair, left, simulated", first.first_png},
                   {"last pair, left, simulated", first.last_png}};
  return page;
}

}  // namespace

std::string trackingTable(const TrackingExperiment& experiment) {
  std::string text;
  for (const auto& row : rowsOf(experiment.sequences.front())) {
    char cell[64];
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::snprintf(cell, sizeof(cell), i == 0 ? "%-38s" : "%9s", row[i].c_str());
      text += cell;
    }
    text += "\n";
  }
  text += "\n";
  for (const auto& [name, fact] : facts(experiment)) {
    char line[256];
    std::snprintf(line, sizeof(line), "%-32s %s\n", (name + ":").c_str(), fact.c_str());
    text += line;
  }
  return text;
}

std::string trackingJson(const TrackingExperiment& experiment) {
  Json json;
  json["experiment"] = "tracking";
  json["simulated"] = true;
  json["report"] = {{"stereo_position_mm", spreadJson(kReportSeenMean)},
                    {"step_length_mm", spreadJson(kReportDistance)},
                    {"predicted_position_mm", spreadJson(kReportPredicted)},
                    {"nine_states", spreadJson(kReportNine)}};
  json["goal_one_step_mm"] = TrackingExperiment::kGoalMm;
  json["mean_one_step_mm"] = meanOneStep(experiment, kPlateAsTold);
  json["mean_one_step_true_rig_mm"] = meanOneStep(experiment, kPlateTrueRig);
  for (const TrackingSequence& sequence : experiment.sequences) {
    Json entry{{"seed", sequence.seed}};
    for (std::size_t view = 0; view < kTrackingViews; ++view) {
      entry[kViewKeys[view]] = errorsJson(sequence.views[view].errors);
    }
    json["sequences"].push_back(entry);
  }
  return json.dump(2) + "\n";
}

void writeTrackingOutputs(const std::filesystem::path& folder,
                          const TrackingExperiment& experiment) {
  writeFileAtomically(folder / "summary.json", trackingJson(experiment));
  writeFileAtomically(folder / "steps.csv", csv(experiment));
  writeFileAtomically(folder / "report.html", reportHtml(page(experiment)));
}

}  // namespace ringhook
