#include "evaluation/sequence_outputs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/angle.h"
#include "core/atomic_file.h"
#include "evaluation/overlay.h"
#include "evaluation/report_page.h"
#include "evaluation/summary_json.h"
#include "evaluation/trajectory_io.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr auto kFramesHeader =
    "time_s,frame,state,reason,x,y,z,qx,qy,qz,qw,var_x_m2,var_y_m2,var_z_m2,var_rx_rad2,"
    "var_ry_rad2,var_rz_rad2,rms_px,features,position_error_mm,rotation_error_deg,left_x_px,"
    "left_y_px,left_width_px,left_height_px,right_x_px,right_y_px,right_width_px,right_height_px,"
    "read_ms,rectify_ms,track_ms,fix_ms\n";

/// An empty field for what is not known.
std::string field(double value) {
  if (!std::isfinite(value)) {
    return ",";
  }
  char text[40];
  std::snprintf(text, sizeof(text), ",%.9g", value);
  return text;
}

std::string withoutCommas(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  return text;
}

std::string windowFields(const Window& window) {
  std::string text;
  for (const int value : {window.x, window.y, window.width, window.height}) {
    text += "," + std::to_string(value);
  }
  return text;
}

std::string poseFields(const FrameRecord& frame) {
  if (!frame.fix) {
    return std::string(15, ',');
  }
  const Eigen::Vector3d p = frame.fix->c1Mo.translation();
  const Eigen::Quaterniond q(frame.fix->c1Mo.linear());
  std::string text;
  for (const double value : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) {
    text += field(value);
  }
  for (int i = 0; i < 6; ++i) {
    text += field(frame.fix->covariance(i, i));
  }
  return text + field(frame.fix->rms_px) + "," + std::to_string(frame.fix->features);
}

std::vector<StampedPose> trajectoryOf(const MethodRun& run) {
  std::vector<StampedPose> poses;
  for (const auto& frame : run.frames) {
    if (frame.fix) {
      poses.push_back({frame.time, frame.fix->c1Mo});
    }
  }
  return poses;
}

std::vector<double> timesOf(const MethodRun& run) {
  std::vector<double> times;
  for (const auto& frame : run.frames) {
    times.push_back(frame.time.seconds());
  }
  return times;
}

template <class Value>
std::vector<double> column(const MethodRun& run, Value value) {
  std::vector<double> values;
  for (const auto& frame : run.frames) {
    values.push_back(value(frame));
  }
  return values;
}

ReportChart positionChart(const MethodRun& run) {
  ReportChart chart{"position of the hook in the left camera, " + run.name + " [m]",
                    {"x", "y", "z"},
                    timesOf(run),
                    {}};
  for (int axis = 0; axis < 3; ++axis) {
    chart.values.push_back(column(run, [axis](const FrameRecord& frame) {
      return frame.fix ? frame.fix->c1Mo.translation()(axis) : kNone;
    }));
  }
  return chart;
}

/// One line a method.
template <class Value>
ReportChart methodsChart(const std::string& title, const std::vector<MethodRun>& runs,
                         Value value) {
  ReportChart chart{title, {}, timesOf(runs.front()), {}};
  for (const auto& run : runs) {
    chart.series.push_back(run.name);
    chart.values.push_back(column(run, value));
  }
  return chart;
}

std::vector<ReportChart> chartsOf(const SequenceOutputs& outputs) {
  std::vector<ReportChart> charts = {positionChart(outputs.runs.front())};
  if (outputs.summaries.front().position_error_mm) {
    charts.push_back(methodsChart("position error [mm]", outputs.runs, [](const FrameRecord& f) {
      return f.position_error ? *f.position_error * 1e3 : kNone;
    }));
    charts.push_back(methodsChart("rotation error [deg]", outputs.runs, [](const FrameRecord& f) {
      return f.rotation_error ? *f.rotation_error / kDegree : kNone;
    }));
  }
  charts.push_back(
      methodsChart("residual, root mean square [px]", outputs.runs,
                   [](const FrameRecord& f) { return f.fix ? f.fix->rms_px : kNone; }));
  charts.push_back(methodsChart("features used", outputs.runs, [](const FrameRecord& f) {
    return f.fix ? static_cast<double>(f.fix->features) : 0.0;
  }));
  charts.push_back(methodsChart("time to track and fix [ms]", outputs.runs,
                                [](const FrameRecord& f) { return (f.track_s + f.fix_s) * 1e3; }));
  return charts;
}

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3f", value);
  return text;
}

std::vector<std::vector<std::string>> resultTable(const SequenceOutputs& outputs) {
  std::vector<std::vector<std::string>> table = {
      {"method", "frames", "tracked", "losses", "reacquired", "false poses", "position mean [mm]",
       "std", "max", "rotation mean [deg]", "std", "max"}};
  for (const auto& s : outputs.summaries) {
    std::vector<std::string> row = {s.method,
                                    std::to_string(s.frames),
                                    std::to_string(s.frames_tracked),
                                    std::to_string(s.losses),
                                    std::to_string(s.reacquisitions),
                                    s.false_poses ? std::to_string(*s.false_poses) : "–"};
    for (const auto& errors : {s.position_error_mm, s.rotation_error_deg}) {
      row.push_back(errors ? shortNumber(errors->mean) : "–");
      row.push_back(errors ? shortNumber(errors->std) : "–");
      row.push_back(errors ? shortNumber(errors->max) : "–");
    }
    table.push_back(std::move(row));
  }
  return table;
}

std::string pageOf(const SequenceOutputs& outputs) {
  constexpr int kPictureWidth = 960;
  ReportPage page;
  page.title = "Sequence " + outputs.sequence;
  page.facts = {{"target", outputs.target},
                {"false pose", "wrong by more than " + shortNumber(outputs.gate_mm) + " mm"},
                {"notes", outputs.notes}};
  if (outputs.interrupted) {
    page.facts.emplace_back("state", "interrupted before the end of the sequence");
  }
  page.table = resultTable(outputs);
  page.charts = chartsOf(outputs);
  const MethodRun& run = outputs.runs.front();
  if (run.first && run.last) {
    page.pictures = {{"first tracked frame, " + run.name, overlayPng(*run.first, kPictureWidth)},
                     {"last tracked frame, " + run.name, overlayPng(*run.last, kPictureWidth)}};
  }
  return reportHtml(page);
}

}  // namespace

std::string framesCsv(const MethodRun& run) {
  std::string text = kFramesHeader;
  for (const auto& frame : run.frames) {
    char stamp[40];
    std::snprintf(stamp, sizeof(stamp), "%.9f", frame.time.seconds());
    text += stamp + std::string(",") + std::to_string(frame.frame) +
            (frame.fix ? ",tracked," : ",lost,") + withoutCommas(frame.reason) + poseFields(frame);
    text += field(frame.position_error ? *frame.position_error * 1e3 : kNone);
    text += field(frame.rotation_error ? *frame.rotation_error / kDegree : kNone);
    text += windowFields(frame.left_window) + windowFields(frame.right_window);
    for (const double seconds : {frame.read_s, frame.rectify_s, frame.track_s, frame.fix_s}) {
      text += field(seconds * 1e3);
    }
    text += "\n";
  }
  return text;
}

std::vector<fs::path> writeSequenceOutputs(const fs::path& folder, const SequenceOutputs& outputs) {
  std::vector<fs::path> written;
  for (std::size_t i = 0; i < outputs.runs.size(); ++i) {
    const MethodRun& run = outputs.runs[i];
    const std::string suffix = i == 0 ? "" : "-" + run.name;
    written.push_back(folder / ("estimate" + suffix + ".tum"));
    writeTum(written.back(), trajectoryOf(run));
    written.push_back(folder / ("frames" + suffix + ".csv"));
    writeFileAtomically(written.back(), framesCsv(run));
  }
  written.push_back(folder / "summary.json");
  writeFileAtomically(written.back(), summaryJson(outputs.summaries, outputs.sequence,
                                                  outputs.gate_mm, outputs.interrupted));
  written.push_back(folder / "report.html");
  writeFileAtomically(written.back(), pageOf(outputs));
  return written;
}

}  // namespace ringhook
