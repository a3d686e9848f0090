#include <cmath>
#include <cstdio>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/atomic_file.h"
#include "core/number_text.h"
#include "evaluation/pendulum_experiment.h"
#include "evaluation/report_page.h"

namespace ringhook {
namespace {

constexpr double kLength = 1.0;  // of the rod [m]

enum class Sign { minus, always };

std::string fixed(double value, int digits, Sign sign = Sign::minus) {
  if (std::isnan(value)) {
    return "-";
  }
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits)
       << (sign == Sign::always ? std::showpos : std::noshowpos) << value;
  return text.str();
}

/// Columns of a row: name, period, both ratios, energy, angle error.
std::vector<std::string> cells(const PendulumCase& one, const PendulumRow& row) {
  const auto against = [&](double period) {
    return period > 0.0 ? fixed(100.0 * (row.period / period - 1.0), 4, Sign::always) : "-";
  };
  return {row.name,
          fixed(row.period, 5),
          against(one.small_period),
          against(one.exact_period),
          fixed(100.0 * row.energy_change, 5, Sign::always),
          fixed(row.angle_error, 6)};
}

const std::vector<std::string>& head() {
  static const std::vector<std::string> names{"",
                                              "period [s]",
                                              "against small swings [%]",
                                              "against exact [%]",
                                              "energy a minute [%]",
                                              "angle error in 10 s [rad]"};
  return names;
}

nlohmann::json rowJson(const PendulumRow& row) {
  nlohmann::json json{{"name", row.name}};
  const auto put = [&](const char* key, double value) {
    if (!std::isnan(value)) {
      json[key] = value;
    }
  };
  put("period_s", row.period);
  put("energy_change_per_minute_percent", 100.0 * row.energy_change);
  put("angle_error_10_s_rad", row.angle_error);
  return json;
}

std::string csv(const PendulumExperiment& experiment) {
  std::string text = "time_s";
  for (const char* damping : {"d0", "d05"}) {
    for (const char* way : {"exact", "simulated", "report_map"}) {
      const std::string stem = std::string(damping) + "_" + way;
      text += "," + stem + "_angle_rad," + stem + "_rate_rad_s";
    }
  }
  text += "\n";
  for (std::size_t i = 0; i < experiment.traces[0][0].size(); ++i) {
    text += exactText(experiment.traces[0][0][i].time_s);
    for (const auto& damping : experiment.traces) {
      for (const auto& trace : damping) {
        text += "," + exactText(trace[i].angle) + "," + exactText(trace[i].rate);
      }
    }
    text += "\n";
  }
  return text;
}

/// One chart of all ways at one damping; `value` takes a sample to what is drawn.
template <class Value>
ReportChart chart(const std::string& title, const std::vector<std::vector<PendulumSample>>& traces,
                  Value&& value) {
  ReportChart drawn{title, {"exact", "simulated", "the report's map"}, {}, {}};
  for (const auto& trace : traces) {
    drawn.values.emplace_back();
    for (const PendulumSample& sample : trace) {
      drawn.values.back().push_back(value(sample));
    }
  }
  for (const PendulumSample& sample : traces.front()) {
    drawn.time_s.push_back(sample.time_s);
  }
  return drawn;
}

ReportPage page(const PendulumExperiment& experiment) {
  ReportPage page;
  page.title = "The 2007 report's pendulum";
  page.facts = {
      {"source", "Jeyabalan, Fork project, section 5.2.2; its figures 5.3 and 5.4 are lost"},
      {"report's statement", "period indeed 2 s, no energy lost without damping"}};
  page.table.push_back(head());
  for (const PendulumCase& one : experiment.cases) {
    page.table.push_back({one.name, "", "", "", "", ""});
    for (const PendulumRow& row : one.rows) {
      page.table.push_back(cells(one, row));
    }
  }
  const char* names[] = {", D = 0", ", D = 0.5"};
  for (std::size_t i = 0; i < experiment.traces.size(); ++i) {
    const auto& traces = experiment.traces[i];
    const std::string name = names[i];
    page.charts.push_back(chart("x coordinate [m]" + name, traces, [](const PendulumSample& s) {
      return kLength * std::sin(s.angle);
    }));
    page.charts.push_back(chart("y coordinate [m]" + name, traces, [](const PendulumSample& s) {
      return -kLength * std::cos(s.angle);
    }));
    page.charts.push_back(chart("velocity [m/s]" + name, traces,
                                [](const PendulumSample& s) { return kLength * s.rate; }));
  }
  return page;
}

}  // namespace

std::string pendulumTable(const PendulumExperiment& experiment) {
  std::string text;
  const auto line = [&](const std::vector<std::string>& columns) {
    char row[256];
    std::snprintf(row, sizeof(row), "%-46s %11s %13s %13s %15s %16s\n", columns[0].c_str(),
                  columns[1].c_str(), columns[2].c_str(), columns[3].c_str(), columns[4].c_str(),
                  columns[5].c_str());
    text += row;
  };
  line(head());
  for (const PendulumCase& one : experiment.cases) {
    text += "\n" + one.name + "\n";
    for (const PendulumRow& row : one.rows) {
      line(cells(one, row));
    }
  }
  return text;
}

std::string pendulumJson(const PendulumExperiment& experiment) {
  nlohmann::json json;
  json["experiment"] = "pendulum";
  for (const PendulumCase& one : experiment.cases) {
    nlohmann::json& entry = json[one.key];
    entry["name"] = one.name;
    entry["small_swing_period_s"] = one.small_period;
    if (one.exact_period > 0.0) {
      entry["exact_period_s"] = one.exact_period;
    }
    for (const PendulumRow& row : one.rows) {
      entry["rows"].push_back(rowJson(row));
    }
  }
  return json.dump(2) + "\n";
}

void writePendulumOutputs(const std::filesystem::path& folder,
                          const PendulumExperiment& experiment) {
  writeFileAtomically(folder / "summary.json", pendulumJson(experiment));
  writeFileAtomically(folder / "trajectories.csv", csv(experiment));
  writeFileAtomically(folder / "report.html", reportHtml(page(experiment)));
}

}  // namespace ringhook
