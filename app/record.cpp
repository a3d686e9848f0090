#include "app/record.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/interrupt.h"
#include "app/options.h"
#include "app/progress.h"
#include "core/error.h"
#include "evaluation/record_run.h"

namespace ringhook {
namespace {

struct RecordArguments {
  RecordJob job;
  std::string cell = RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml";
  std::string out;
  std::string follow;
  std::vector<int> left_window;
  std::vector<int> right_window;
  double rate_hz = 0.0;
  std::string json;
};

Window windowFrom(const std::vector<int>& numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

RecordJob jobFrom(const RecordArguments& arguments) {
  RecordJob job = arguments.job;
  job.cell_file = arguments.cell;
  job.out = arguments.out;
  if (arguments.rate_hz > 0.0) {
    job.rate_hz = arguments.rate_hz;
  }
  if (!arguments.left_window.empty()) {
    job.windows = {windowFrom(arguments.left_window), windowFrom(arguments.right_window)};
  }
  if (!arguments.follow.empty()) {
    job.follow = arguments.follow == "edges" ? TrackerKind::kEdges : TrackerKind::kMarker;
  }
  return job;
}

std::string reportJson(const RecordJob& job, const RecordReport& report) {
  nlohmann::ordered_json json;
  json["sequence"] = job.out.string();
  json["frames"] = report.frames;
  json["duration_s"] = report.duration_s;
  json["frames_left_out"] = report.left_out;
  json["frames_missed_by_camera"] = report.missed;
  json["frames_not_stored"] = report.before;
  json["target"] = report.target;
  json["simulated"] = !report.scenario.empty();
  if (!report.scenario.empty()) {
    json["scenario"] = report.scenario;
    json["seed"] = job.choice.seed;
    json["frames_without_truth"] = report.without_truth;
  }
  json["interrupted"] = report.interrupted;
  return json.dump(2) + "\n";
}

void printEnd(const RecordJob& job, const RecordReport& report) {
  std::printf("%zu frames, %.2f s from first to last, target %s\n", report.frames,
              report.duration_s, report.target.c_str());
  if (report.before > 0) {
    std::printf("%zu frames were looked at and not stored: no hook was well tracked in them\n",
                report.before);
  }
  if (report.left_out + report.missed > 0) {
    std::printf("missing: %zu frames that the disk was too slow for, %zu that the camera lost\n",
                report.left_out, report.missed);
  }
  if (report.frames > 0) {
    std::printf("written: %s (play it with ringhook evaluate sequence %s)\n", job.out.c_str(),
                job.out.c_str());
  }
  std::fflush(stdout);
}

/// The summary would be in the way of the sequence, and of the next one in its place.
void refuseWithin(const std::string& out, const std::string& json) {
  namespace fs = std::filesystem;
  if (json.empty() || out.empty()) {
    return;
  }
  const fs::path below = fs::absolute(json).lexically_normal().lexically_relative(
      fs::absolute(out).lexically_normal());
  if (*below.begin() != "..") {
    throw InputError("--json " + json + ": expected a place outside of the sequence folder " + out);
  }
}

void runCommand(const RecordArguments& arguments) {
  if (arguments.left_window.empty() != arguments.right_window.empty()) {
    throw InputError("record: expected --left-window and --right-window together");
  }
  if (!arguments.follow.empty() && !arguments.left_window.empty()) {
    throw InputError("record: expected either --follow or windows, since the former chooses them");
  }
  refuseWithin(arguments.out, arguments.json);
  const RecordJob job = jobFrom(arguments);
  JsonFile json(arguments.json);
  Progress progress("recording");
  const RecordReport report =
      runRecord(job, interruptRequested(),
                [&](double fraction, const std::string& note) { progress.show(fraction, note); });
  progress.clear();
  json.commit(reportJson(job, report));
  printEnd(job, report);
  if (report.interrupted) {
    throw Interrupted("stopped by the operator: " +
                      (report.frames > 0
                           ? std::to_string(report.frames) + " frames kept in " + job.out.string()
                           : "no frame was stored"));
  }
}

void addWhatToRecord(CLI::App& command, RecordArguments& arguments) {
  command.add_option("--cell", arguments.cell, "Cell file; default: the simulated cell")
      ->type_name("FILE");
  command.add_option("--scenario", arguments.job.choice.scenario, "Scenario of a simulated cell")
      ->type_name("NAME");
  command
      .add_option("--seed", arguments.job.choice.seed, "Of everything random in a simulated cell")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--frames", arguments.job.frames, "Pairs to store; default as --seconds says")
      ->check(CLI::Range(1, 10000000));
  command
      .add_option("--seconds", arguments.job.seconds, "How long, from the first stored frame on")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
  command.add_option("--rate", arguments.rate_hz, "Pairs a second; default: the cell file's")
      ->check(CLI::Range(0.1, 1000.0))
      ->type_name("HZ");
  command
      .add_option("--follow", arguments.follow,
                  "Windows follow a hook; stored is what shows it well tracked")
      ->check(CLI::IsMember({"marker", "edges"}));
  command
      .add_option("--wait", arguments.job.wait_s, "For the hook that --follow looks for, seconds")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
  for (const auto& [name, window] : {std::pair{"--left-window", &arguments.left_window},
                                     std::pair{"--right-window", &arguments.right_window}}) {
    command.add_option(name, *window, "Of the full image [px]; default: all of it")
        ->delimiter(',')
        ->expected(4)
        ->check(CLI::Range(0, 100000))
        ->type_name("X,Y,W,H");
  }
}

void addWhereTo(CLI::App& command, RecordArguments& arguments) {
  command.add_option("--out", arguments.out, "Sequence folder to make")
      ->required()
      ->type_name("DIR");
  command.add_flag("--overwrite", arguments.job.overwrite,
                   "Replace an earlier recording there; anything else is never touched");
  command
      .add_option("--format", arguments.job.image_format,
                  "Of the images: smaller, or faster to write")
      ->check(CLI::IsMember({"png", "pgm"}))
      ->capture_default_str();
  command.add_option("--name", arguments.job.name, "Of the sequence; default: the cell's")
      ->type_name("TEXT");
  command.add_option("--notes", arguments.job.notes, "For sequence.yaml")->type_name("TEXT");
  command.add_option("--licence", arguments.job.licence, "For sequence.yaml")->type_name("TEXT");
  addJsonOption(command, arguments.json, "Also write the counts here");
}

}  // namespace

void addRecordCommand(CLI::App& app) {
  auto arguments = std::make_shared<RecordArguments>();
  CLI::App& command = addCommand(
      app, "record", "Stores a sequence from any cell",
      "Examples:\n"
      "  ringhook record --follow marker --seconds 5 --seed 1 --out out/swing\n"
      "  ringhook record --left-window 700,600,512,512 --right-window 700,600,512,512 \\\n"
      "                  --frames 100 --out out/fixed\n"
      "Ctrl-C ends it and keeps the frames that are whole; so does a full disk.");
  addWhatToRecord(command, *arguments);
  addWhereTo(command, *arguments);
  command.callback([arguments] { runCommand(*arguments); });
}

}  // namespace ringhook
