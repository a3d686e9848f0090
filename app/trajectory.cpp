#include "app/trajectory.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/options.h"
#include "core/error.h"
#include "evaluation/trajectory_compare.h"
#include "evaluation/trajectory_models.h"
#include "evaluation/trajectory_outputs.h"

namespace ringhook {
namespace {

struct TrajectoryFlags {
  std::string file;
  std::vector<std::string> columns;
  std::optional<double> rate_hz;
  TrajectoryEvaluationOptions evaluation;
  std::string out;
  std::string json;
};

struct CompareFlags {
  std::string reference;
  std::string estimate;
  std::string align = "none";
  double max_difference_s = 0.01;
  std::string json;
};

constexpr auto kTrajectoryExample = R"(Examples:
  ringhook evaluate trajectory swing.csv --horizons 0.1,0.2,0.5 --json swing.json
  ringhook evaluate trajectory flight.csv --columns x=load_x,y=load_y,z=load_z --rate 29.3)";
constexpr auto kCompareExample =
    "Example: ringhook evaluate compare truth.tum estimate.tum --align se3 --json error.json";

/// "x=load_x" and the like.
std::map<std::string, std::string> columnsFrom(const std::vector<std::string>& words) {
  std::map<std::string, std::string> columns;
  for (const auto& word : words) {
    const auto equals = word.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == word.size()) {
      throw InputError("--columns " + word + ": expected NAME=COLUMN, as in x=load_x");
    }
    if (!columns.emplace(word.substr(0, equals), word.substr(equals + 1)).second) {
      throw InputError("--columns: expected each name once, found " + word.substr(0, equals) +
                       " again");
    }
  }
  return columns;
}

void runTrajectory(const TrajectoryFlags& flags) {
  JsonFile json(flags.json);
  const Trajectory trajectory =
      readTrajectory(flags.file, {columnsFrom(flags.columns), flags.rate_hz});
  const TrajectoryResult result = evaluateTrajectory(trajectory, flags.evaluation);
  std::printf("%s", trajectoryTable(result).c_str());
  if (!flags.out.empty()) {
    writeTrajectoryOutputs(flags.out, result);
    std::printf("written: %s (report.html, summary.json, frames.csv)\n", flags.out.c_str());
  }
  json.commit(trajectoryJson(result));
  if (!result.summaries.front().predicts) {
    throw Error(result.summaries.front().name + " never began to predict " + trajectory.name +
                ": " + result.summaries.front().note);
  }
}

void runCompare(const CompareFlags& flags) {
  JsonFile json(flags.json);
  const Alignment alignment = alignmentFromText(flags.align);
  if (!(flags.max_difference_s >= 0.0)) {
    throw InputError("--max-difference: expected a number of seconds, at least 0");
  }
  const PositionPairs pairs = pairTracks(readPositionTrack(flags.reference),
                                         readPositionTrack(flags.estimate), flags.max_difference_s);
  const TrackError error = trackError(pairs, alignment);
  std::printf("%zu pairs, alignment %s\n", error.pairs, flags.align.c_str());
  if (alignment == Alignment::kSim3) {
    std::printf("scale  %12.7f\n", error.scale);
  }
  std::printf("rmse   %12.7f m\nmean   %12.7f m\nmedian %12.7f m\n", error.rmse_m, error.mean_m,
              error.median_m);
  std::printf("std    %12.7f m\nmin    %12.7f m\nmax    %12.7f m\n", error.std_m, error.min_m,
              error.max_m);
  json.commit(trackErrorJson(error, alignment));
}

}  // namespace

void addTrajectoryCommand(CLI::App& evaluate) {
  auto flags = std::make_shared<TrajectoryFlags>();
  TrajectoryEvaluationOptions& options = flags->evaluation;
  CLI::App& command = addCommand(evaluate, "trajectory",
                                 "Predict a recorded trajectory with all models, side by side.",
                                 kTrajectoryExample);
  std::string known;
  for (const auto& name : motionModelNames()) {
    known += ", " + name;
  }
  command.add_option("FILE", flags->file, "trajectory.csv: angles or points")->required();
  command.add_option("--columns", flags->columns, "other column names, as in x=load_x,y=load_y")
      ->delimiter(',');
  command.add_option("--rate", flags->rate_hz, "samples per second of a file without time_s [Hz]");
  command.add_option("--horizons", options.horizons_s, "how far ahead to predict [s]")
      ->delimiter(',')
      ->capture_default_str();
  command
      .add_option("--models", options.models, "all" + known + "; the first is the main one (all)")
      ->delimiter(',');
  command.add_option("--noise", options.noise,
                     "measurement noise of each number [rad or m] (estimated from the data)");
  command.add_option("--length", options.length_m,
                     "effective length of the linear pendulums [m] (from the first seconds)");
  command.add_option("--warm-up", options.warm_up_s, "time before predictions are judged [s]")
      ->capture_default_str();
  command.add_option("--out", flags->out, "folder for report.html, summary.json and frames.csv");
  addJsonOption(command, flags->json, "write summary.json to this file");
  command.callback([flags] { runTrajectory(*flags); });
}

void addCompareCommand(CLI::App& evaluate) {
  auto flags = std::make_shared<CompareFlags>();
  CLI::App& command = addCommand(
      evaluate, "compare", "Trajectory error between two TUM or two KITTI files.", kCompareExample);
  command.add_option("REF", flags->reference, "reference trajectory")->required();
  command.add_option("EST", flags->estimate, "estimated trajectory")->required();
  command
      .add_option("--align", flags->align,
                  "lay the estimate on the reference first: none, se3, sim3")
      ->capture_default_str();
  command
      .add_option("--max-difference", flags->max_difference_s,
                  "largest difference of two times that are one instant [s]")
      ->capture_default_str();
  addJsonOption(command, flags->json, "write the result to this file");
  command.callback([flags] { runCompare(*flags); });
}

}  // namespace ringhook
