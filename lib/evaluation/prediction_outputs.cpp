#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/number_text.h"
#include "evaluation/prediction_experiment.h"
#include "evaluation/report_page.h"

namespace ringhook {
namespace {

std::string fixed(double value, int digits = 3) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

const std::vector<std::string>& head() {
  static const std::vector<std::string> names{
      "RMS per coordinate [mm]", "33 ms", "100 ms", "300 ms", "says", "NEES", "bound", "seeds"};
  return names;
}

std::vector<std::string> cells(const PredictionRow& row) {
  return {row.name,
          fixed(row.rms_mm[0]),
          fixed(row.rms_mm[1]),
          fixed(row.rms_mm[2]),
          fixed(row.said_mm),
          fixed(row.nees, 2),
          row.bound_mm > 0.0 ? fixed(row.bound_mm) : "",
          std::to_string(row.seeds)};
}

std::string tableLine(const std::vector<std::string>& cells) {
  char text[200];
  std::snprintf(text, sizeof(text), "%-54s %8s %8s %8s %8s %8s %8s %6s\n", cells[0].c_str(),
                cells[1].c_str(), cells[2].c_str(), cells[3].c_str(), cells[4].c_str(),
                cells[5].c_str(), cells[6].c_str(), cells[7].c_str());
  return text;
}

std::string share(int part, int of) { return std::to_string(part) + " of " + std::to_string(of); }

std::vector<std::pair<std::string, std::string>> facts(const PredictionExperiment& experiment) {
  const auto stop = [](const StopResult& r) {
    return share(r.back, r.seeds) + " below 1 mm at 300 ms from 1 s after the belt stands (RMS " +
           fixed(r.rms_after_mm) + ", worst " + fixed(r.worst_mm) + " mm), " +
           std::to_string(r.diverged) + " diverged";
  };
  const ConsistencyResult& c = experiment.consistency;
  return {{"seen",
           "simulated hooks at 50 Hz, 0.2 mm of noise per axis, 1 mrad where poses are "
           "seen; belt 0.2 m/s; 3 s seen unless said otherwise"},
          {"belt stops, poses", stop(experiment.stop) + "; gate fired in " +
                                    share(experiment.stop.gated, experiment.stop.seeds) +
                                    ", told as a change of speed in " +
                                    share(experiment.stop.noticed, experiment.stop.seeds)},
          {"belt stops, points, all unknown", stop(experiment.stop_points)},
          {"consistency, poses", "mean NIS inside its 95 % band in " + share(c.inside, c.seeds) +
                                     " runs; mean " + fixed(c.nis_mean) +
                                     " per degree; mean NEES of the pose " + fixed(c.nees_mean) +
                                     " per degree (" + fixed(c.nees_band[0]) + " to " +
                                     fixed(c.nees_band[1]) + " if consistent)"},
          {"where it was, poses",
           "by the filter at the time " + fixed(experiment.smoother.filter_mm) +
               " mm, by the smoother afterwards " + fixed(experiment.smoother.smoother_mm) +
               " mm (" + std::to_string(experiment.smoother.seeds) + " seeds)"}};
}

nlohmann::ordered_json stopJson(const StopResult& r) {
  return {{"seeds", r.seeds},
          {"told_as_speed_change", r.noticed},
          {"gate_fired", r.gated},
          {"back_below_1_mm", r.back},
          {"diverged", r.diverged},
          {"rms_after_mm", r.rms_after_mm},
          {"worst_after_mm", r.worst_mm}};
}

std::string stopCsv(const PredictionExperiment& experiment) {
  std::string text = "time_s,poses_rms_mm,points_rms_mm\n";
  const auto& poses = experiment.stop.course_mm;
  const auto& points = experiment.stop_points.course_mm;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    text += fixed(0.02 * static_cast<double>(i), 2) + "," + exactText(poses[i]) + "," +
            exactText(points[i]) + "\n";
  }
  return text;
}

ReportPage page(const PredictionExperiment& experiment) {
  ReportPage page;
  page.title = "Prediction of the travelling, swinging hook (simulated)";
  page.facts = facts(experiment);
  page.table.push_back(head());
  for (const PredictionRow& row : experiment.rows) {
    page.table.push_back(cells(row));
  }
  ReportChart chart{
      "error at 300 ms [mm] from the stop's beginning on; the belt stands after 0.6 s",
      {"poses", "points"},
      {},
      {experiment.stop.course_mm, experiment.stop_points.course_mm}};
  for (std::size_t i = 0; i < experiment.stop.course_mm.size(); ++i) {
    chart.time_s.push_back(0.02 * static_cast<double>(i));
  }
  page.charts = {chart};
  return page;
}

}  // namespace

std::string predictionTable(const PredictionExperiment& experiment) {
  std::string text = tableLine(head());
  for (const PredictionRow& row : experiment.rows) {
    text += tableLine(cells(row));
  }
  for (const auto& [name, fact] : facts(experiment)) {
    text += name + ": " + fact + "\n";
  }
  return text;
}

std::string predictionJson(const PredictionExperiment& experiment) {
  nlohmann::ordered_json json;
  json["simulated"] = true;
  for (const PredictionRow& row : experiment.rows) {
    nlohmann::ordered_json one{
        {"rms_33_ms_mm", row.rms_mm[0]},      {"rms_100_ms_mm", row.rms_mm[1]},
        {"rms_300_ms_mm", row.rms_mm[2]},     {"said_300_ms_mm", row.said_mm},
        {"nees_300_ms_per_degree", row.nees}, {"seeds", row.seeds}};
    if (row.bound_mm > 0.0) {
      one["cramer_rao_300_ms_mm"] = row.bound_mm;
    }
    json["rows"][row.key] = one;
  }
  json["belt_stop_poses"] = stopJson(experiment.stop);
  json["belt_stop_points"] = stopJson(experiment.stop_points);
  json["consistency"] = {{"seeds", experiment.consistency.seeds},
                         {"nis_inside_95", experiment.consistency.inside},
                         {"nis_mean_per_degree", experiment.consistency.nis_mean},
                         {"nees_mean_per_degree", experiment.consistency.nees_mean},
                         {"nees_band_95", experiment.consistency.nees_band}};
  json["smoother"] = {{"seeds", experiment.smoother.seeds},
                      {"filter_rms_mm", experiment.smoother.filter_mm},
                      {"smoother_rms_mm", experiment.smoother.smoother_mm}};
  return json.dump(2) + "\n";
}

void writePredictionOutputs(const std::filesystem::path& folder,
                            const PredictionExperiment& experiment) {
  writeFileAtomically(folder / "summary.json", predictionJson(experiment));
  writeFileAtomically(folder / "stop.csv", stopCsv(experiment));
  writeFileAtomically(folder / "report.html", reportHtml(page(experiment)));
}

}  // namespace ringhook
