#include "app/calibrate_verify.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/calibrate_job.h"
#include "app/options.h"
#include "app/progress.h"
#include "calib/solve/verify.h"
#include "calib/solve/verify_views.h"
#include "core/angle.h"
#include "core/error.h"

namespace ringhook {
namespace {

constexpr std::size_t kMostFrames = 40;

struct VerifyJob {
  std::string rig;
  std::string left;
  std::string right;
  std::string board;
  std::string sequence;
  std::string target;
  std::string bar;
  std::optional<double> bar_mm;
  double tolerance_mm = 0.3;
  std::string json;
};

void requireSources(const VerifyJob& job) {
  const bool images = !job.left.empty() || !job.right.empty() || !job.board.empty();
  if (images == !job.sequence.empty()) {
    throw InputError("expected either --left, --right and --board, or --sequence");
  }
  if (images && (job.left.empty() || job.right.empty() || job.board.empty())) {
    throw InputError("expected all of --left, --right and --board");
  }
  if (images && (!job.target.empty() || !job.bar.empty() || job.bar_mm)) {
    throw InputError("--target, --bar and --bar-mm belong to --sequence; a board has its own bar");
  }
  if (job.bar_mm && (job.bar.empty() || !(*job.bar_mm >= 1.0 && *job.bar_mm <= 1e5))) {
    throw InputError("--bar-mm: expected the length in millimetres from 1 to 100000, with --bar");
  }
}

Verification verifyImages(const VerifyJob& job, const StereoRig& rig,
                          const VerifyOptions& options) {
  const Board board = parseBoard(job.board);
  const auto left = expandGlob(job.left, "--left");
  const auto right = expandGlob(job.right, "--right");
  StereoViews views;
  {
    Progress progress("finding the board");
    views = findViews(left, right, board, hookFor(progress));
  }
  for (const RejectedView& view : views.rejected) {
    std::printf("not used: %s\n", view.reason.c_str());
  }
  if (!views.usable.empty() && (views.usable.front().width != rig.left.width ||
                                views.usable.front().height != rig.left.height)) {
    throw InputError("--left: the images are " + std::to_string(views.usable.front().width) + "x" +
                     std::to_string(views.usable.front().height) + " px, expected the rig's " +
                     std::to_string(rig.left.width) + "x" + std::to_string(rig.left.height));
  }
  return verifyRig(rig, views, board, options);
}

Verification verifySequence(const VerifyJob& job, const StereoRig& rig, VerifyOptions options) {
  const Sequence sequence = openSequence(job.sequence);
  const std::filesystem::path target =
      job.target.empty() ? sequence.target_file : std::filesystem::path(job.target);
  if (target.empty()) {
    throw InputError("--target: the sequence names no tag plate, expected a marker.yaml");
  }
  const TagPlate plate = loadTagPlate(target);
  if (!job.bar.empty()) {
    int a = 0, b = 0;
    char rest = '\0';
    if (std::sscanf(job.bar.c_str(), "%9d,%9d%c", &a, &b, &rest) != 2) {
      throw InputError("--bar: '" + job.bar + "' is not two tag ids, as in 0,1");
    }
    options.bar = barBetween(plate, a, b);
    options.bar->known_m = job.bar_mm ? 1e-3 * *job.bar_mm : options.bar->known_m;
  }
  std::vector<SightedView> views;
  {
    Progress progress("finding the plate");
    views = sightPlate(sequence, rig, plate, kMostFrames, hookFor(progress));
  }
  return verifyRig(rig, views, options);
}

nlohmann::json listOf(const Eigen::Vector3d& v, double unit) {
  return {unit * v.x(), unit * v.y(), unit * v.z()};
}

nlohmann::json summary(const Verification& v) {
  const CameraMove& m = v.moved;
  return {{"verdict", toString(v.state)},
          {"reasons", v.reasons},
          {"views", v.views},
          {"points", v.points},
          {"distance_m", v.distance_m},
          {"vertical_disparity_px", {{"mean", v.rows.mean_px}, {"rms", v.rows.rms_px}}},
          {"expected_px", v.rows.expected_px},
          {"row_pattern_px",
           {{"offset", v.rows.offset_px},
            {"along_x", v.rows.along_x_px},
            {"along_y", v.rows.along_y_px}}},
          {"corner_sigma_px", v.corner_sigma_px},
          {"expected_sigma_px", v.expected_sigma_px},
          {"bar_mm",
           {{"known", 1e3 * v.bar.known_m},
            {"count", v.bar.count},
            {"mean_error", 1e3 * v.bar.mean_m},
            {"rms_error", 1e3 * v.bar.rms_m},
            {"worst_error", 1e3 * v.bar.worst_m}}},
          {"camera_moved_deg", listOf(m.rotation_rad, 1.0 / kDegree)},
          {"camera_moved_sigma_deg", listOf(m.rotation_sigma_rad, 1.0 / kDegree)},
          {"camera_moved_mm", listOf(m.translation_m, 1e3)},
          {"camera_moved_sigma_mm", listOf(m.translation_sigma_m, 1e3)},
          {"camera_moved_chi_square", m.chi_square},
          {"camera_moved_chi_square_limit", m.limit},
          {"cost_mm", 1e3 * m.cost_m},
          {"focal_changed_percent",
           {{"left", 100.0 * v.focal.left_share}, {"right", 100.0 * v.focal.right_share}}}};
}

void printVector(const char* name, const Eigen::Vector3d& value, const Eigen::Vector3d& sigma,
                 double unit, const char* unit_name) {
  std::printf("%-27s x %.4f +- %.4f, y %.4f +- %.4f, z %.4f +- %.4f %s\n", name, unit * value.x(),
              unit * sigma.x(), unit * value.y(), unit * sigma.y(), unit * value.z(),
              unit * sigma.z(), unit_name);
}

void printResult(const Verification& v) {
  std::printf("views                       %d with %d points, %.2f m away\n", v.views, v.points,
              v.distance_m);
  std::printf("rows (vertical disparity)   mean %.4f px, RMS %.4f px, expected %.4f px\n",
              v.rows.mean_px, v.rows.rms_px, v.rows.expected_px);
  std::printf(
      "  over the image            offset %.3f px, to the right border %+.3f, to the lower "
      "%+.3f px\n",
      v.rows.offset_px, v.rows.along_x_px, v.rows.along_y_px);
  std::printf("corner noise                %.4f px per axis, expected %.4f px\n", v.corner_sigma_px,
              v.expected_sigma_px);
  std::printf("bar of %.2f mm           mean error %.4f mm, RMS %.4f mm, worst %.4f mm (%d)\n",
              1e3 * v.bar.known_m, 1e3 * v.bar.mean_m, 1e3 * v.bar.rms_m, 1e3 * v.bar.worst_m,
              v.bar.count);
  printVector("right camera has turned", v.moved.rotation_rad, v.moved.rotation_sigma_rad,
              1.0 / kDegree, "deg");
  printVector("right camera has shifted", v.moved.translation_m, v.moved.translation_sigma_m, 1e3,
              "mm");
  std::printf(
      "evidence for that           chi-square %.1f, by chance below %.1f; it costs %.3f mm\n",
      v.moved.chi_square, v.moved.limit, 1e3 * v.moved.cost_m);
  std::printf("verdict: %s\n", toString(v.state).c_str());
  for (const std::string& reason : v.reasons) {
    std::printf("  %s\n", reason.c_str());
  }
}

void verify(const VerifyJob& job) {
  requireSources(job);
  if (!(job.tolerance_mm >= 1e-3 && job.tolerance_mm <= 1e3)) {
    throw InputError("--tolerance-mm: expected a number of millimetres from 0.001 to 1000");
  }
  JsonFile json(job.json);
  const StereoRig rig = loadRig(job.rig);
  VerifyOptions options;
  options.tolerance_m = 1e-3 * job.tolerance_mm;
  const Verification result =
      job.sequence.empty() ? verifyImages(job, rig, options) : verifySequence(job, rig, options);
  json.commit(summary(result).dump(2) + "\n");
  printResult(result);
  if (result.state != RigState::kOk) {
    throw Error(job.rig + ": " + toString(result.state) + ": " + result.reasons.front());
  }
}

}  // namespace

void addCalibrateVerify(CLI::App& calibrate) {
  auto job = std::make_shared<VerifyJob>();
  CLI::App& command = addCommand(
      calibrate, "verify",
      "Compare an accepted rig with new views: ok, recalibrate or moved camera.",
      "Examples:\n"
      "  ringhook calibrate verify --rig rig.yaml --left 'new/left*.png' \\\n"
      "    --right 'new/right*.png' --board chessboard:9x6:25mm --json verify.json\n"
      "  ringhook calibrate verify --rig rig.yaml --sequence recording --bar 0,1\n"
      "Exit code 1: recalibrate or moved camera. How it decides: doc/calibration-check.md");
  command.add_option("--rig", job->rig, "the accepted rig")->required()->type_name("FILE");
  command.add_option("--left", job->left, "left images, a quoted pattern; paired by name order");
  command.add_option("--right", job->right, "right images, a quoted pattern");
  command.add_option("--board", job->board, "as in calibrate stereo");
  command.add_option("--sequence", job->sequence, "or a stored sequence that shows a tag plate")
      ->type_name("DIR");
  command.add_option("--target", job->target, "marker.yaml, if the sequence names none")
      ->type_name("FILE");
  command.add_option("--bar", job->bar, "two tag ids whose distance is to be measured")
      ->type_name("ID,ID");
  command.add_option("--bar-mm", job->bar_mm,
                     "their distance, if better known than the plate says");
  command.add_option("--tolerance-mm", job->tolerance_mm, "harmless shift of points")
      ->capture_default_str();
  addJsonOption(command, job->json, "write the figures to this file");
  command.callback([job] { verify(*job); });
}

}  // namespace ringhook
