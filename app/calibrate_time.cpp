#include "app/calibrate_time.h"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/calibrate_job.h"
#include "app/interrupt.h"
#include "app/options.h"
#include "app/progress.h"
#include "calib/wizard/place_delays.h"
#include "camera/sequence.h"
#include "core/angle.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

struct TimeArguments {
  std::string cell = RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml";
  std::string sequence;
  std::string keep;
  std::string target;
  std::string rig;
  std::string out;
  std::string json;
  std::uint64_t seed = 1;
  WiggleOptions wiggle;
  bool yes = false;
};

/// What the delays are found from, and where from.
struct Watched {
  StereoRig told;
  std::filesystem::path rig_file;
  std::string place;
  WiggleRecord record;
};

DelayStep stepFor(Progress& progress) {
  return [&progress](double fraction, const std::string& note) {
    if (interruptRequested()) {
      progress.clear();
      throw Interrupted("stopped by the operator; the arm stands still, nothing was written");
    }
    progress.show(fraction, note);
  };
}

void throwIfInterrupted() {
  if (interruptRequested()) {
    throw Interrupted("stopped by the operator; the arm stands still, nothing was written");
  }
}

std::filesystem::path targetFor(const TimeArguments& arguments,
                                const std::filesystem::path& otherwise, const char* where) {
  if (!arguments.target.empty()) {
    return arguments.target;
  }
  if (otherwise.empty()) {
    throw InputError(
        std::string("--target is missing: expected the marker.yaml of the plate on the "
                    "gripper, since ") +
        where + " names none");
  }
  return otherwise;
}

void confirm(CalibrationPlace& place, const TimeArguments& arguments) {
  if (!place.needsConfirmation()) {
    return;
  }
  if (!arguments.yes) {
    std::fprintf(
        stderr,
        "%s: the arm will move to the cell file's standby pose and then swing every joint by "
        "up to %.1f degrees for %.0f s.\nIs everybody out of reach, is the way free? "
        "Type yes: ",
        place.name().c_str(), 2.5 * arguments.wiggle.amplitude_rad / kDegree,
        arguments.wiggle.seconds);
    std::string answer;
    std::getline(std::cin, answer);
    if (answer != "yes") {
      throw Interrupted("not confirmed: nothing was moved");
    }
  }
  place.confirmMotion();
}

Watched watchCell(const TimeArguments& arguments) {
  const CellConfig cell = loadCellConfig(arguments.cell);
  Watched watched;
  watched.rig_file = arguments.rig.empty() ? cell.rig : std::filesystem::path(arguments.rig);
  watched.told = loadRig(watched.rig_file);
  const std::filesystem::path target =
      targetFor(arguments, cell.arm.gripper_plate, "the cell file's arm section");
  const TagPlate plate = loadTagPlate(target);
  SimulatedPlaceOptions options;
  options.seed = arguments.seed;
  const std::unique_ptr<CalibrationPlace> place = cell.devices.kind == DeviceKind::kSimulated
                                                      ? openSimulatedPlace(cell, options)
                                                      : openNetworkPlace(cell);
  place->onStep(throwIfInterrupted);
  confirm(*place, arguments);
  watched.place = place->name();
  Progress progress("watching the arm");
  Outcome<WiggleRecord> record = recordWiggle(*place, cell, watched.told, plate, arguments.wiggle,
                                              stepFor(progress), {arguments.keep, target});
  progress.clear();
  if (!record) {
    throw Error(watched.place + ": " + record.reason());
  }
  watched.record = *record;
  return watched;
}

Watched watchSequence(const TimeArguments& arguments) {
  if (!isFolder(arguments.sequence)) {
    throw InputError("--sequence " + arguments.sequence + ": expected a sequence folder");
  }
  Watched watched;
  watched.rig_file = arguments.rig.empty() ? std::filesystem::path(arguments.sequence) / "rig.yaml"
                                           : std::filesystem::path(arguments.rig);
  watched.told = loadRig(watched.rig_file);
  watched.place = "sequence " + arguments.sequence;
  std::filesystem::path target = openSequence(arguments.sequence).target_file;
  if (target.extension() == ".cao") {
    target.clear();  // edges, no tags
  }
  const TagPlate plate = loadTagPlate(targetFor(arguments, target, "the sequence"));
  Progress progress("reading");
  watched.record = readWiggle(arguments.sequence, watched.told, plate, stepFor(progress));
  return watched;
}

void addDelay(nlohmann::ordered_json& json, const std::string& name,
              const std::optional<KnownDelay>& delay) {
  if (delay) {
    json[name + "_ms"] = 1e3 * delay->value_s;
    json[name + "_sigma_ms"] = 1e3 * delay->sigma_s;
  }
}

std::string summary(const Watched& watched, const DelayReport& report) {
  nlohmann::ordered_json json;
  json["place"] = watched.place;
  addDelay(json, "robot_delay", report.robot);
  addDelay(json, "camera_delay", report.camera);
  json["robot_minus_camera_stamps_ms"] = 1e3 * report.offset.offset_s;
  json["robot_minus_camera_stamps_sigma_ms"] = 1e3 * report.offset.sigma_s;
  if (report.response) {
    json["response_delay_ms"] = 1e3 * report.response->delay_s;
    json["response_delay_sigma_ms"] = 1e3 * report.response->sigma_s;
    json["arm_delay_ms"] = 1e3 * report.arm_delay_s.value_or(0.0);
  }
  json["frames"] = report.frames;
  json["frames_used"] = report.offset.views;
  json["residual_px"] = report.offset.rms_px;
  json["residual_without_delay_px"] = report.offset.rms_without_px;
  json["image_speed_px_s"] = report.offset.image_speed_px_s;
  json["verdict"] = report.grade == DelayGrade::ok ? "ok" : "bad";
  json["verdict_sentence"] = report.sentence;
  return json.dump(2) + "\n";
}

void printDelay(const char* what, const std::optional<KnownDelay>& delay, const char* otherwise) {
  if (delay) {
    std::printf("%-42s %7.3f ms, sigma %.3f\n", what, 1e3 * delay->value_s, 1e3 * delay->sigma_s);
  } else {
    std::printf("%-42s %s\n", what, otherwise);
  }
}

void print(const Watched& watched, const DelayReport& report) {
  const TimeOffset& offset = report.offset;
  std::printf("%s\n", watched.place.c_str());
  std::printf("%-42s %d of %d, the plate moving at %.0f px/s\n", "frames used:", offset.views,
              report.frames, offset.image_speed_px_s);
  std::printf("%-42s %.3f px (%.3f px without the delay)\n",
              "corners against the arm's states:", offset.rms_px, offset.rms_without_px);
  std::printf("%-42s %7.3f ms, sigma %.3f\n",
              "arm's stamps behind the cameras':", 1e3 * offset.offset_s, 1e3 * offset.sigma_s);
  printDelay("arm, sampling to stamp (robot_delay_ms):", report.robot, "as told: not known apart");
  printDelay("camera, mid-exposure to arrival:", report.camera, "not known from a recording");
  if (report.response) {
    std::printf("%-42s %7.3f ms, sigma %.3f; arm.delay_ms of the cell file: %.1f\n",
                "state to the motion that answers it:", 1e3 * report.response->delay_s,
                1e3 * report.response->sigma_s, 1e3 * report.arm_delay_s.value_or(0.0));
  }
  std::printf("verdict: %s: %s\n", report.grade == DelayGrade::ok ? "ok" : "bad",
              report.sentence.c_str());
}

/// Places that cannot be written are found out before the arm moves.
void checkOutputs(const TimeArguments& arguments) {
  if (!arguments.out.empty()) {
    const AtomicFile probe(arguments.out);
  }
  const std::filesystem::path keep = arguments.keep;
  if (!keep.empty() && (isFile(keep) || (isFolder(keep) && !std::filesystem::is_empty(keep)))) {
    throw InputError("--keep " + arguments.keep + ": expected a new or empty folder");
  }
}

void calibrateTime(const TimeArguments& arguments) {
  checkOutputs(arguments);
  JsonFile json(arguments.json);
  const Watched watched =
      arguments.sequence.empty() ? watchCell(arguments) : watchSequence(arguments);
  const Outcome<DelayReport> report = delaysOf(watched.record, watched.told);
  if (!report) {
    throw Error(watched.place + ": " + report.reason());
  }
  json.commit(summary(watched, *report));
  print(watched, *report);
  if (report->grade != DelayGrade::ok) {
    throw Error("the delays were not found: the verdict above says why; no rig was written");
  }
  if (!arguments.out.empty()) {
    StereoRig rig = withDelays(watched.told, *report);
    rig.date = utcDate();
    rig.tool_version = RINGHOOK_VERSION;
    saveRig(arguments.out, rig);
    std::printf("wrote %s: %s with these delays\n", arguments.out.c_str(),
                watched.rig_file.string().c_str());
  }
}

void addWhatToWatch(CLI::App& time, TimeArguments& arguments) {
  CLI::Option* cell =
      time.add_option("--cell", arguments.cell, "Cell file; default: the simulated cell")
          ->type_name("FILE");
  CLI::Option* seed =
      time.add_option("--seed", arguments.seed, "Of everything random in a simulated cell")
          ->check(CLI::NonNegativeNumber)
          ->capture_default_str();
  CLI::Option* seconds =
      time.add_option("--seconds", arguments.wiggle.seconds, "How long the arm moves")
          ->check(CLI::Range(3.0, 120.0))
          ->capture_default_str();
  CLI::Option* keep = time.add_option("--keep", arguments.keep,
                                      "Also store what was seen, as a sequence for --sequence")
                          ->type_name("DIR");
  time.add_flag("--yes", arguments.yes, "Do not ask before a real arm moves");
  time.add_option("--sequence", arguments.sequence,
                  "A recorded sequence with robot.csv instead of a cell")
      ->type_name("DIR")
      ->excludes(cell)
      ->excludes(seed)
      ->excludes(seconds)
      ->excludes(keep);
  time.add_option("--target", arguments.target,
                  "marker.yaml of the plate on the gripper; default: the cell's or the sequence's")
      ->type_name("FILE");
  time.add_option("--rig", arguments.rig, "Rig with fMc1; default: the cell's or the sequence's")
      ->type_name("FILE");
}

}  // namespace

void addCalibrateTime(CLI::App& calibrate) {
  auto arguments = std::make_shared<TimeArguments>();
  CLI::App& time = addCommand(
      calibrate, "time", "Find the delays of cameras and arm from a small motion that both watch.",
      "Examples:\n"
      "  ringhook calibrate time --seed 1 --out rig.yaml --json delays.json\n"
      "  ringhook calibrate time --cell cell.yaml --out rig.yaml\n"
      "  ringhook calibrate time --keep DIR ; ringhook calibrate time --sequence DIR\n"
      "A real arm asks before it moves. Ctrl-C stops it. What the figures mean: doc/delays.md");
  addWhatToWatch(time, *arguments);
  time.add_option("--out", arguments->out, "Rig to write: the one told, with the delays")
      ->type_name("FILE");
  addJsonOption(time, arguments->json, "Also write the figures here");
  time.callback([arguments] { calibrateTime(*arguments); });
}

}  // namespace ringhook
