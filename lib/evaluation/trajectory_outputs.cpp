#include "evaluation/trajectory_outputs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/number_text.h"
#include "evaluation/trajectory_page.h"

namespace ringhook {
namespace {

using Json = nlohmann::ordered_json;

/// With so many digits that count.
std::string brief(double value, int digits = 4) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.*g", digits, value);
  return text;
}

std::string fixed(double value, int digits) {
  char text[48];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

constexpr std::size_t kNameWidth = 24;
constexpr std::size_t kNumberWidth = 11;

std::string left(std::string text, std::size_t width = kNameWidth) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string right(const std::string& text, std::size_t width = kNumberWidth) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

const char* unitOf(const TrajectoryResult& result) {
  return isAngular(result.trajectory.kind) ? "rad" : "m";
}

/// Absent where there is no number.
void put(Json& json, const std::string& key, double value) {
  if (std::isfinite(value)) {
    json[key] = value;
  }
}

Json toJson(const ModelSummary& summary, const char* unit) {
  Json json;
  json["model"] = summary.name;
  json["predicts"] = summary.predicts;
  json["horizons"] = Json::array();
  for (const HorizonResult& one : summary.horizons) {
    Json entry{{"horizon_s", one.horizon_s}};
    put(entry, "rms", one.rms);
    entry["unit"] = unit;
    entry["samples"] = one.samples;
    put(entry, "horizontal_rms", one.horizontal_rms.value_or(std::nan("")));
    json["horizons"].push_back(entry);
  }
  json["parameters"] = Json::object();
  for (const NamedParameter& parameter : summary.parameters) {
    put(json["parameters"], parameter.key, parameter.value);
    put(json["parameters"], parameter.key + "_std", parameter.sigma);
  }
  put(json, "nis_mean", summary.nis_mean);
  json["nis_degrees"] = summary.nis_degrees;
  put(json, "nis_inside_95", summary.nis_inside_95);
  json["refused"] = summary.refused;
  json["note"] = summary.note;
  return json;
}

std::string headTable(const TrajectoryResult& result) {
  const bool angles = isAngular(result.trajectory.kind);
  const auto& times = result.trajectory.times;
  return result.trajectory.name + ": " + std::to_string(times.size()) + " samples, " +
         brief(1.0 / result.step_s) + " Hz, " + brief(times.back() - times.front()) + " s, " +
         std::to_string(result.repeated) + (angles ? " repeated" : " repeated and left out") +
         "\nmeasurement noise " + brief(1e3 * result.noise) + (angles ? " mrad (" : " mm (") +
         (result.noise_estimated ? "estimated from the data" : "as told") + "); judged from " +
         brief(result.judged_from_s) + " s on\n";
}

std::string modelRow(const ModelSummary& summary, bool horizontal) {
  std::string row = left(summary.name);
  if (!summary.predicts) {
    return row + "  " + summary.note + "\n";
  }
  for (const HorizonResult& one : summary.horizons) {
    row += right(fixed(1e3 * (horizontal ? one.horizontal_rms.value_or(0.0) : one.rms), 3));
  }
  if (!horizontal) {
    row += right(brief(summary.nis_mean, 3)) + " of " + std::to_string(summary.nis_degrees) +
           right(fixed(100.0 * summary.nis_inside_95, 1));
  }
  return row + "\n";
}

std::string tableOf(const TrajectoryResult& result, const char* title, bool horizontal) {
  std::string text = "\n" + left(title);
  for (const HorizonTruth& one : result.truth) {
    text += right(brief(one.horizon_s) + " s");
  }
  text += horizontal ? "\n" : right("NIS mean", kNumberWidth + 5) + right("% in 95 %") + "\n";
  for (const ModelSummary& summary : result.summaries) {
    text += modelRow(summary, horizontal);
  }
  return text;
}

std::string parameterLine(const ModelSummary& summary) {
  std::string text;
  for (const NamedParameter& parameter : summary.parameters) {
    text += (text.empty() ? "" : ", ") + parameter.key + " " + brief(parameter.value, 5);
    text += parameter.sigma > 0.0 ? " +- " + brief(parameter.sigma, 2) : "";
  }
  return text.empty() ? "" : left(summary.name) + "  " + text + "\n";
}

std::string csvHeader(const TrajectoryResult& result) {
  const auto names = predictedNames(result.trajectory.kind);
  std::string text = "time_s";
  for (const auto& name : names) {
    text += "," + name;
  }
  for (std::size_t m = 0; m < result.runs.size(); ++m) {
    const std::string model = "," + result.runs[m].name + "_";
    text += model + "nis";
    for (const NamedParameter& parameter : result.summaries[m].parameters) {
      text += model + parameter.key + model + parameter.key + "_std";
    }
    for (const HorizonTruth& one : result.truth) {
      for (const auto& name : names) {
        text += model + "error_" + exactText(one.horizon_s) + "s_" + name;
      }
    }
  }
  return text + "\n";
}

std::string field(double value) { return "," + (std::isfinite(value) ? exactText(value) : ""); }

std::string csvFields(const TrajectoryResult& result, std::size_t model, std::size_t sample) {
  const ModelRun& run = result.runs[model];
  const FilterUpdate& update = run.updates[sample];
  std::string text = update.degrees > 0 ? field(update.nis) : ",";
  const auto& parameters = run.parameters[sample];
  for (std::size_t i = 0; i < result.summaries[model].parameters.size(); ++i) {
    text += i < parameters.size() ? field(parameters[i].value) + field(parameters[i].sigma) : ",,";
  }
  for (const Eigen::MatrixXd& errors : run.errors) {
    for (const double error : errors.col(static_cast<Eigen::Index>(sample))) {
      text += field(error);
    }
  }
  return text;
}

}  // namespace

std::string trajectoryTable(const TrajectoryResult& result) {
  const bool angles = isAngular(result.trajectory.kind);
  std::string text = headTable(result);
  text += tableOf(result, angles ? "RMS error [mrad]" : "RMS per axis [mm]", false);
  if (!angles) {
    text += tableOf(result, "horizontal RMS [mm]", true);
  }
  text += "\n";
  for (const ModelSummary& summary : result.summaries) {
    text += parameterLine(summary);
  }
  return text;
}

std::string trajectoryJson(const TrajectoryResult& result) {
  const char* unit = unitOf(result);
  const auto& times = result.trajectory.times;
  Json json = toJson(result.summaries.front(), unit);
  json["trajectory"] = result.trajectory.name;
  json["samples"] = times.size();
  json["repeated_samples"] = result.repeated;
  json["duration_s"] = times.back() - times.front();
  json["rate_hz"] = 1.0 / result.step_s;
  json["judged_from_s"] = result.judged_from_s;
  json[std::string("noise_") + unit] = result.noise;
  json["noise_estimated"] = result.noise_estimated;
  json["models"] = Json::object();
  for (const ModelSummary& summary : result.summaries) {
    json["models"][summary.name] = toJson(summary, unit);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string trajectoryCsv(const TrajectoryResult& result) {
  std::string text = csvHeader(result);
  const Eigen::Index size = predictedSize(result.trajectory.kind);
  for (std::size_t i = 0; i < result.trajectory.times.size(); ++i) {
    text += secondsText(result.trajectory.times[i]);
    for (const double number : result.trajectory.values[i].head(size)) {
      text += field(number);
    }
    for (std::size_t model = 0; model < result.runs.size(); ++model) {
      text += csvFields(result, model, i);
    }
    text += "\n";
  }
  return text;
}

void writeTrajectoryOutputs(const std::filesystem::path& folder, const TrajectoryResult& result) {
  writeFileAtomically(folder / "summary.json", trajectoryJson(result));
  writeFileAtomically(folder / "frames.csv", trajectoryCsv(result));
  writeFileAtomically(folder / "report.html", reportHtml(trajectoryPage(result)));
}

}  // namespace ringhook
