#include "app/calibrate_stereo.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/calibrate_job.h"
#include "app/dialogue.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/stereo_report.h"
#include "calib/solve/stereo_calibration.h"
#include "calib/solve/stereo_images.h"
#include "calib/wizard/wizard.h"
#include "core/error.h"
#include "rig/stereo_rig.h"

namespace ringhook {
namespace {

constexpr auto kUsualShots = "out/shots";

struct StereoJob {
  std::string left;
  std::string right;
  std::string cell;
  std::string shots;
  std::optional<std::uint64_t> seed;
  std::string board;
  std::string distortion = "auto";
  bool board_shape = false;
  std::string out;
  std::string json;
};

StereoOptions optionsOf(const StereoJob& job) {
  StereoOptions options;
  if (job.distortion != "auto") {
    options.terms = static_cast<LensTerms>(std::stoi(job.distortion));
  }
  options.board_shape = job.board_shape;
  return options;
}

void requireSource(const StereoJob& job) {
  const bool stored = !job.left.empty() && !job.right.empty();
  const bool any_stored = !job.left.empty() || !job.right.empty();
  if (stored == !job.cell.empty() || any_stored != stored) {
    throw InputError("expected either --left and --right, or --cell");
  }
  if (job.cell.empty() && (!job.shots.empty() || job.seed)) {
    throw InputError("--shots and --seed go with --cell only");
  }
}

/// Pictures taken now, by the wizard's first step.
StereoViews liveViews(const StereoJob& job) {
  WizardOptions options;
  options.session = job.shots.empty() ? kUsualShots : job.shots;
  options.cell = job.cell;
  options.board = job.board;
  options.seed = job.seed;
  Console console = terminal();
  return takeBoardPairs(options, console, progressOf, leaveIfAsked);
}

StereoViews viewsOf(const StereoJob& job, const Board& board) {
  if (!job.cell.empty()) {
    return liveViews(job);
  }
  const auto left = expandGlob(job.left, "--left");
  const auto right = expandGlob(job.right, "--right");
  Progress progress("finding the board");
  return findViews(left, right, board, hookFor(progress));
}

StereoCalibration run(const StereoJob& job) {
  const Board board = parseBoard(job.board);
  const StereoViews views = viewsOf(job, board);
  Progress progress("calibrating");
  return calibrateStereo(views, board, optionsOf(job), hookFor(progress));
}

void write(const StereoJob& job, const StereoCalibration& c) {
  StereoRig rig = c.rig;
  rig.date = utcDate();
  rig.tool_version = RINGHOOK_VERSION;
  saveRig(job.out, rig);
}

void calibrateRig(const StereoJob& job) {
  requireSource(job);
  JsonFile json(job.json);
  const StereoCalibration result = run(job);
  write(job, result);
  json.commit(summaryOf(result).dump(2) + "\n");
  printResult(result, parseBoard(job.board));
  std::printf("wrote %s\n", job.out.c_str());
}

}  // namespace

void addCalibrateStereo(CLI::App& calibrate) {
  auto job = std::make_shared<StereoJob>();
  CLI::App& stereo = addCommand(
      calibrate, "stereo",
      "Calibrate both cameras and the pose between them from pictures of a board.",
      "Examples:\n"
      "  ringhook calibrate stereo --left 'shots/left*.png' --right 'shots/right*.png' \\\n"
      "    --board chessboard:9x6:25mm --out rig.yaml --json rig.json\n"
      "  ringhook calibrate stereo --cell app/config/cell-sim.yaml --board chessboard:9x6:30mm \\\n"
      "    --out rig.yaml\n"
      "What the figures mean: doc/calibration.md");
  stereo.add_option("--left", job->left, "left images, a quoted pattern; paired by name order");
  stereo.add_option("--right", job->right, "right images, a quoted pattern");
  stereo.add_option(
      "--cell", job->cell,
      "take the pictures now, with this cell's cameras, and say how to hold the board");
  stereo.add_option("--shots", job->shots,
                    std::string("where pictures taken now are kept; a job left is taken up there, "
                                "and calibrate wizard --session goes on with it (") +
                        kUsualShots + ")");
  stereo.add_option("--seed", job->seed, "of a simulated cell (1)")->check(CLI::NonNegativeNumber);
  stereo
      .add_option("--board", job->board,
                  "chessboard:9x6:25mm, charuco:8x6:30mm:22mm, circles:7x5:20mm, "
                  "acircles:4x11:20mm or apriltags:6x6:30mm:9mm; lengths in mm, cm or m")
      ->required();
  stereo
      .add_option("--distortion", job->distortion,
                  "distortion terms per camera; auto chooses by views held out")
      ->check(CLI::IsMember({"auto", "0", "5", "8"}))
      ->capture_default_str();
  stereo.add_flag("--board-shape", job->board_shape,
                  "find the board's own shape as well: prints are never quite flat");
  stereo.add_option("--out", job->out, "rig file to write (rig.yaml)")->required();
  addJsonOption(stereo, job->json, "write the figures to this file");
  stereo.callback([job] { calibrateRig(*job); });
}

}  // namespace ringhook
