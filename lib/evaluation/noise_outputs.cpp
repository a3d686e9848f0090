#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/number_text.h"
#include "evaluation/noise_experiment.h"
#include "evaluation/report_page.h"

namespace ringhook {
namespace {

constexpr double kReportSigmaMm = 0.785;  // its table 6.2, mean over x, y, z
constexpr int kPositions = 21;

std::string fixed(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

std::vector<std::string> cells(const NoiseRow& row) {
  return {fixed(row.ratio, 4), fixed(kReportSigmaMm * row.mean, 3),
          fixed(kReportSigmaMm * row.settled_rms, 3), std::to_string(row.settled_after),
          fixed(row.nis, 3)};
}

const std::vector<std::string>& head() {
  static const std::vector<std::string> names{"process / measurement", "mean error [mm]",
                                              "settled RMS [mm]", "settled after", "NIS / degree"};
  return names;
}

nlohmann::ordered_json rowsJson(const std::vector<NoiseRow>& rows) {
  auto json = nlohmann::ordered_json::array();
  for (const NoiseRow& row : rows) {
    json.push_back({{"ratio", row.ratio},
                    {"mean_error_mm", kReportSigmaMm * row.mean},
                    {"settled_rms_mm", kReportSigmaMm * row.settled_rms},
                    {"settled_after_positions", row.settled_after},
                    {"nis_per_degree", row.nis}});
  }
  return json;
}

std::string csv(const NoiseExperiment& experiment) {
  std::string text = "process_noise,ratio,mean_error,settled_rms,settled_after,nis_per_degree\n";
  const auto put = [&text](const char* kind, const std::vector<NoiseRow>& rows) {
    for (const NoiseRow& row : rows) {
      text += std::string(kind) + "," + exactText(row.ratio) + "," + exactText(row.mean) + "," +
              exactText(row.settled_rms) + "," + std::to_string(row.settled_after) + "," +
              exactText(row.nis) + "\n";
    }
  };
  put("diagonal", experiment.diagonal);
  put("white-jerk", experiment.jerk);
  return text;
}

/// Both kinds over the power of ten of the ratio; `value` takes a row to what is drawn.
template <class Value>
ReportChart chart(const std::string& title, const NoiseExperiment& experiment, Value value) {
  ReportChart drawn{title + "; time is log10 of the ratio",
                    {"the report's diagonal", "white jerk"},
                    {},
                    std::vector<std::vector<double>>(2)};
  for (std::size_t i = 0; i < experiment.diagonal.size(); ++i) {
    drawn.time_s.push_back(std::log10(experiment.diagonal[i].ratio));
    drawn.values[0].push_back(value(experiment.diagonal[i]));
    drawn.values[1].push_back(value(experiment.jerk[i]));
  }
  return drawn;
}

ReportPage page(const NoiseExperiment& experiment) {
  ReportPage page;
  page.title = "What noise values do to the 2007 report's filter";
  page.facts = {{"source", "Jeyabalan, Fork project, sections 6.2.2 and 6.3.3"},
                {"motion", "21 positions, 29.34 mm apart along y, one a second"},
                {"measurement noise", fixed(kReportSigmaMm, 3) + " mm per axis (its table 6.2)"},
                {"no process noise", fixed(kReportSigmaMm * parabolaDeviation(kPositions - 1), 3) +
                                         " mm at the last position, by least squares"}};
  page.table.push_back(head());
  for (const auto& [name, rows] : {std::pair{"the report's diagonal", experiment.diagonal},
                                   std::pair{"white jerk", experiment.jerk}}) {
    page.table.push_back({name, "", "", "", ""});
    for (const NoiseRow& row : rows) {
      page.table.push_back(cells(row));
    }
  }
  page.charts = {
      chart("one-step error, mean [mm]", experiment,
            [](const NoiseRow& row) { return kReportSigmaMm * row.mean; }),
      chart("one-step error once settled, RMS [mm]", experiment,
            [](const NoiseRow& row) { return kReportSigmaMm * row.settled_rms; }),
      chart("NIS per degree of freedom", experiment, [](const NoiseRow& row) { return row.nis; })};
  return page;
}

}  // namespace

std::string noiseTable(const NoiseExperiment& experiment) {
  std::string text;
  const auto line = [&text](const std::vector<std::string>& columns) {
    for (const auto& column : columns) {
      char cell[64];
      std::snprintf(cell, sizeof(cell), "%22s", column.c_str());
      text += cell;
    }
    text += "\n";
  };
  for (const auto& [name, rows] : {std::pair{"the report's diagonal", experiment.diagonal},
                                   std::pair{"white jerk", experiment.jerk}}) {
    text += std::string(name) + "\n";
    line(head());
    for (const NoiseRow& row : rows) {
      line(cells(row));
    }
    text += "\n";
  }
  return text;
}

std::string noiseJson(const NoiseExperiment& experiment) {
  nlohmann::ordered_json json;
  json["experiment"] = "noise";
  json["measurement_noise_mm"] = kReportSigmaMm;
  json["no_process_noise_mm"] = kReportSigmaMm * parabolaDeviation(kPositions - 1);
  json["diagonal"] = rowsJson(experiment.diagonal);
  json["white_jerk"] = rowsJson(experiment.jerk);
  return json.dump(2) + "\n";
}

void writeNoiseOutputs(const std::filesystem::path& folder, const NoiseExperiment& experiment) {
  writeFileAtomically(folder / "summary.json", noiseJson(experiment));
  writeFileAtomically(folder / "noise.csv", csv(experiment));
  writeFileAtomically(folder / "report.html", reportHtml(page(experiment)));
}

}  // namespace ringhook
