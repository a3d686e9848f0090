#include "evaluation/report_page.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "evaluation/overlay.h"

namespace ringhook {
namespace {

constexpr auto kStyle = R"(
body { font: 15px/1.45 sans-serif; color: #1c2733; max-width: 1000px; margin: 2em auto; padding: 0 1em }
h1 { font-size: 1.5em } h2 { font-size: 1.1em; margin: 1.6em 0 .3em }
table { border-collapse: collapse } th, td { padding: .25em .8em; border-bottom: 1px solid #d5dbe1; text-align: right }
th:first-child, td:first-child { text-align: left } th { background: #f1f4f7 }
.facts td { text-align: left } .chart { width: 100%; height: 220px }
figure { margin: 1em 0 } figcaption { color: #55626f } img { max-width: 100% }
.dygraph-legend { background: rgba(255,255,255,.85) }
)";

constexpr auto kDrawCharts = R"(
const charts = JSON.parse(document.getElementById('charts').textContent);
const drawn = charts.map((chart, i) => new Dygraph(document.getElementById('chart' + i), chart.rows, {
  labels: ['time [s]'].concat(chart.series), xlabel: 'time [s]', connectSeparatedPoints: false,
  strokeWidth: 1.4, legend: 'always', labelsSeparateLines: false, digitsAfterDecimal: 4,
  colors: ['#1668b8', '#d1542a', '#2a8f4e', '#8450b5', '#907a00', '#444444'] }));
)";

std::string readText(const std::string& name) {
  const std::string path = std::string(RINGHOOK_DYGRAPHS_DIR) + "/" + name;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw Error("cannot read " + path + " for the report page: install libjs-dygraphs");
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

/// Six digits are more than a chart shows; a gap is null.
nlohmann::json number(double value) {
  if (!std::isfinite(value)) {
    return nullptr;
  }
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return std::stod(text);
}

std::string chartData(const std::vector<ReportChart>& charts) {
  nlohmann::json json = nlohmann::json::array();
  for (const auto& chart : charts) {
    nlohmann::json rows = nlohmann::json::array();
    for (std::size_t i = 0; i < chart.time_s.size(); ++i) {
      nlohmann::json row = {chart.time_s[i]};
      for (const auto& values : chart.values) {
        row.push_back(number(values[i]));
      }
      rows.push_back(std::move(row));
    }
    json.push_back({{"series", chart.series}, {"rows", std::move(rows)}});
  }
  std::string text = json.dump();
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3) {
    text.replace(at, 2, "<\\/");
  }
  return text;
}

std::string factsHtml(const ReportPage& page) {
  std::string html = "<table class=\"facts\">\n";
  for (const auto& [name, text] : page.facts) {
    html += "<tr><td>" + escaped(name) + "</td><td>" + escaped(text) + "</td></tr>\n";
  }
  return html + "</table>\n";
}

std::string tableHtml(const ReportPage& page) {
  std::string html = "<h2>Results</h2>\n<table>\n";
  for (std::size_t row = 0; row < page.table.size(); ++row) {
    const std::string cell = row == 0 ? "th" : "td";
    html += "<tr>";
    for (const auto& text : page.table[row]) {
      html += "<" + cell + ">" + escaped(text) + "</" + cell + ">";
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace

std::string reportHtml(const ReportPage& page) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  html += "<title>" + escaped(page.title) + "</title>\n<style>" + readText("dygraph.min.css") +
          kStyle + "</style>\n<script>" + readText("dygraph.min.js") +
          "</script>\n</head>\n<body>\n";
  html += "<h1>" + escaped(page.title) + "</h1>\n" + factsHtml(page) + tableHtml(page);
  for (const auto& [caption, png] : page.pictures) {
    html += "<figure><img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64," +
            base64(png) + "\"><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
  }
  for (std::size_t i = 0; i < page.charts.size(); ++i) {
    html += "<h2>" + escaped(page.charts[i].title) + "</h2>\n<div class=\"chart\" id=\"chart" +
            std::to_string(i) + "\"></div>\n";
  }
  html += R"(<script type="application/json" id="charts">)" + chartData(page.charts) +
          "</script>\n<script>" + kDrawCharts + "</script>\n</body>\n</html>\n";
  return html;
}

}  // namespace ringhook
