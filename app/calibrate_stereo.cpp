#include "app/calibrate_stereo.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/calibrate_job.h"
#include "app/options.h"
#include "app/progress.h"
#include "calib/solve/stereo_calibration.h"
#include "calib/solve/stereo_images.h"
#include "core/error.h"
#include "rig/stereo_rig.h"

namespace ringhook {
namespace {

struct StereoJob {
  std::string left;
  std::string right;
  std::string board;
  int distortion = 5;
  std::string out;
  std::string json;
};

StereoCalibration run(const StereoJob& job) {
  const Board board = parseBoard(job.board);
  const auto left = expandGlob(job.left, "--left");
  const auto right = expandGlob(job.right, "--right");
  StereoViews views;
  {
    Progress progress("finding the board");
    views = findViews(left, right, board, hookFor(progress));
  }
  Progress progress("calibrating");
  return calibrateStereo(views, board, {static_cast<LensTerms>(job.distortion)}, hookFor(progress));
}

nlohmann::json summary(const StereoCalibration& c) {
  nlohmann::json rejected = nlohmann::json::array();
  for (const RejectedView& v : c.rejected) {
    rejected.push_back({{"left", v.left_name}, {"right", v.right_name}, {"reason", v.reason}});
  }
  nlohmann::json views = nlohmann::json::array();
  for (const UsedView& v : c.used) {
    views.push_back({{"left", v.left_name},
                     {"right", v.right_name},
                     {"left_rms_px", v.error.left_px},
                     {"right_rms_px", v.error.right_px},
                     {"rms_px", v.error.both_px},
                     {"heldout_vertical_disparity_px", v.heldout_rows_px}});
  }
  nlohmann::json result{{"rms_px", c.rms_px},
                        {"corner_sigma_px", c.corner_sigma_px},
                        {"heldout_vertical_disparity_px", c.heldout_vertical_disparity_px},
                        {"heldout_folds", c.folds},
                        {"baseline_m", baseline(c.rig)},
                        {"views_used", c.used.size()},
                        {"views_rejected", rejected},
                        {"views", views},
                        {"verdict", toString(c.verdict.grade)},
                        {"verdict_sentence", c.verdict.sentence}};
  if (c.uncertainty) {
    result["focal_sigma_px"] = c.uncertainty->focal_px;
    result["baseline_sigma_m"] = c.uncertainty->baseline_m;
  }
  return result;
}

void printCamera(const char* name, const CameraModel& camera) {
  std::printf("%-5s  f %.2f %.2f px, c %.2f %.2f px, distortion", name, camera.K(0, 0),
              camera.K(1, 1), camera.K(0, 2), camera.K(1, 2));
  for (const double k : camera.distortion) {
    std::printf(" %.4f", k);
  }
  std::printf("%s\n", camera.distortion.size() == 0 ? " none" : "");
}

void printViews(const StereoCalibration& c) {
  std::printf("%-20s %-20s %9s %9s %12s\n", "left", "right", "left_px", "right_px", "heldout_px");
  for (const UsedView& v : c.used) {
    std::printf("%-20s %-20s %9.3f %9.3f %12.3f\n", v.left_name.c_str(), v.right_name.c_str(),
                v.error.left_px, v.error.right_px, v.heldout_rows_px);
  }
  for (const RejectedView& v : c.rejected) {
    std::printf("%-20s %-20s rejected, %s\n", v.left_name.c_str(), v.right_name.c_str(),
                v.reason.c_str());
  }
}

void printResult(const StereoCalibration& c) {
  printViews(c);
  std::printf("\n");
  printCamera("left", c.rig.left);
  printCamera("right", c.rig.right.value());
  std::printf("views used                  %zu, rejected %zu\n", c.used.size(), c.rejected.size());
  std::printf("reprojection RMS            %.4f px (corner noise %.4f px per axis)\n", c.rms_px,
              c.corner_sigma_px);
  std::printf("held-out vertical disparity %.4f px (%d folds)\n", c.heldout_vertical_disparity_px,
              c.folds);
  std::printf("baseline                    %.3f mm", 1e3 * baseline(c.rig));
  if (c.uncertainty) {
    std::printf(" (sigma %.3f mm; focal lengths %.2f px)", 1e3 * c.uncertainty->baseline_m,
                c.uncertainty->focal_px);
  }
  std::printf("\nverdict: %s: %s\n", toString(c.verdict.grade).c_str(), c.verdict.sentence.c_str());
}

void write(const StereoJob& job, const StereoCalibration& c) {
  StereoRig rig = c.rig;
  rig.date = utcDate();
  rig.tool_version = RINGHOOK_VERSION;
  saveRig(job.out, rig);
}

void calibrateRig(const StereoJob& job) {
  JsonFile json(job.json);
  const StereoCalibration result = run(job);
  write(job, result);
  json.commit(summary(result).dump(2) + "\n");
  printResult(result);
  std::printf("wrote %s\n", job.out.c_str());
}

}  // namespace

void addCalibrateStereo(CLI::App& calibrate) {
  auto job = std::make_shared<StereoJob>();
  CLI::App& stereo = addCommand(
      calibrate, "stereo",
      "Calibrate both cameras and the pose between them from pictures of a board.",
      "Example:\n"
      "  ringhook calibrate stereo --left 'shots/left*.png' --right 'shots/right*.png' \\\n"
      "    --board chessboard:9x6:25mm --out rig.yaml --json rig.json\n"
      "What the figures mean: doc/calibration.md");
  stereo.add_option("--left", job->left, "left images, a quoted pattern; paired by name order")
      ->required();
  stereo.add_option("--right", job->right, "right images, a quoted pattern")->required();
  stereo
      .add_option("--board", job->board,
                  "chessboard:COLUMNSxROWS:SQUARE, inner corners counted, square in mm, cm or m")
      ->required();
  stereo.add_option("--distortion", job->distortion, "distortion coefficients per camera")
      ->check(CLI::IsMember({0, 5, 8}))
      ->capture_default_str();
  stereo.add_option("--out", job->out, "rig file to write (rig.yaml)")->required();
  addJsonOption(stereo, job->json, "write the figures to this file");
  stereo.callback([job] { calibrateRig(*job); });
}

}  // namespace ringhook
