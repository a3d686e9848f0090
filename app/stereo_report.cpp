#include "app/stereo_report.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/angle.h"

namespace ringhook {
namespace {

std::vector<double> listOf(const Eigen::VectorXd& v) { return {v.begin(), v.end()}; }

nlohmann::json lensSigmas(const LensSigma& sigma) {
  return {{"focal_px", listOf(sigma.focal_px)},
          {"centre_px", listOf(sigma.centre_px)},
          {"distortion", listOf(sigma.distortion)}};
}

nlohmann::json sigmas(const Uncertainty& u) {
  return {{"left", lensSigmas(u.left)},
          {"right", lensSigmas(u.right)},
          {"rotation_rad", listOf(u.rotation_rad)},
          {"translation_m", listOf(u.translation_m)},
          {"baseline_m", u.baseline_m},
          {"position_m", listOf(u.position_m)},
          {"position_distance_m", kTypicalDistance_m}};
}

// Numbers that do not exist (a lens model that did not fit) are null.
nlohmann::json finiteOrNull(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

nlohmann::json lensTable(const StereoCalibration& c) {
  nlohmann::json table = nlohmann::json::array();
  for (const LensCandidate& lens : c.lenses) {
    table.push_back({{"distortion_terms", static_cast<int>(lens.terms)},
                     {"rms_px", finiteOrNull(lens.rms_px)},
                     {"heldout_vertical_disparity_px", finiteOrNull(lens.heldout_px)},
                     {"chosen", lens.chosen}});
  }
  return table;
}

nlohmann::json viewTable(const StereoCalibration& c) {
  nlohmann::json views = nlohmann::json::array();
  for (const UsedView& v : c.used) {
    views.push_back({{"left", v.left_name},
                     {"right", v.right_name},
                     {"left_rms_px", v.error.left_px},
                     {"right_rms_px", v.error.right_px},
                     {"rms_px", v.error.both_px},
                     {"points", v.error.points},
                     {"heldout_vertical_disparity_px", v.heldout_rows_px}});
  }
  return views;
}

}  // namespace

nlohmann::json summaryOf(const StereoCalibration& c) {
  nlohmann::json rejected = nlohmann::json::array();
  for (const RejectedView& v : c.rejected) {
    rejected.push_back({{"left", v.left_name}, {"right", v.right_name}, {"reason", v.reason}});
  }
  nlohmann::json result{{"rms_px", c.rms_px},
                        {"corner_sigma_px", c.corner_sigma_px},
                        {"heldout_vertical_disparity_px", c.heldout_vertical_disparity_px},
                        {"heldout_folds", c.folds},
                        {"distortion_terms", static_cast<int>(c.terms)},
                        {"lens_models", lensTable(c)},
                        {"baseline_m", baseline(c.rig)},
                        {"views_used", c.used.size()},
                        {"views_rejected", rejected},
                        {"views", viewTable(c)},
                        {"verdict", toString(c.verdict.grade)},
                        {"verdict_sentence", c.verdict.sentence}};
  if (c.uncertainty) {
    result["focal_sigma_px"] = c.uncertainty->focal_px;
    result["baseline_sigma_m"] = c.uncertainty->baseline_m;
    result["sigma"] = sigmas(*c.uncertainty);
  }
  for (const Eigen::Vector3d& p : c.board_points) {
    result["board_points_m"].push_back(listOf(p));
  }
  return result;
}

namespace {

void printNumbers(const char* name, const Eigen::VectorXd& values, const Eigen::VectorXd* sigma,
                  int decimals, const char* unit) {
  std::printf("  %-22s", name);
  for (int i = 0; i < values.size(); ++i) {
    std::printf("  %.*f", decimals, values[i]);
    if (sigma != nullptr) {
      std::printf(" +- %.*f", decimals + 1, (*sigma)[i]);
    }
  }
  std::printf("%s%s\n", values.size() == 0 ? "  none" : " ", values.size() == 0 ? "" : unit);
}

void printCamera(const char* name, const CameraModel& camera, const LensSigma* sigma) {
  const Eigen::VectorXd focal = Eigen::Vector2d(camera.K(0, 0), camera.K(1, 1));
  const Eigen::VectorXd centre = Eigen::Vector2d(camera.K(0, 2), camera.K(1, 2));
  const Eigen::VectorXd focal_sigma = sigma != nullptr ? Eigen::VectorXd(sigma->focal_px) : focal;
  const Eigen::VectorXd centre_sigma =
      sigma != nullptr ? Eigen::VectorXd(sigma->centre_px) : centre;
  std::printf("%s\n", name);
  printNumbers("focal lengths fx fy", focal, sigma != nullptr ? &focal_sigma : nullptr, 2, "px");
  printNumbers("centre cx cy", centre, sigma != nullptr ? &centre_sigma : nullptr, 2, "px");
  printNumbers("distortion", camera.distortion, sigma != nullptr ? &sigma->distortion : nullptr, 4,
               "");
}

void printPose(const StereoCalibration& c) {
  const Eigen::VectorXd turn = thetaU(c.rig.c2Mc1.linear()) / kDegree;
  const Eigen::VectorXd shift = 1e3 * c.rig.c2Mc1.translation();
  Eigen::VectorXd turn_sigma;
  Eigen::VectorXd shift_sigma;
  if (c.uncertainty) {
    turn_sigma = c.uncertainty->rotation_rad / kDegree;
    shift_sigma = 1e3 * c.uncertainty->translation_m;
  }
  std::printf("left camera in the right one\n");
  printNumbers("rotation vector", turn, c.uncertainty ? &turn_sigma : nullptr, 4, "deg");
  printNumbers("translation", shift, c.uncertainty ? &shift_sigma : nullptr, 3, "mm");
}

void printLenses(const StereoCalibration& c) {
  if (c.lenses.empty()) {
    return;
  }
  std::printf("\n%-18s %8s %11s\n", "distortion terms", "rms_px", "heldout_px");
  for (const LensCandidate& lens : c.lenses) {
    std::printf("%-18d %8.4f %11.4f%s\n", static_cast<int>(lens.terms), lens.rms_px,
                lens.heldout_px, lens.chosen ? "   chosen" : "");
  }
}

// How far the board's points lie off the print's plane and grid [mm].
void printShape(const StereoCalibration& c, const Board& board) {
  if (c.board_points.empty()) {
    return;
  }
  const std::vector<Eigen::Vector3d> printed = board.points();
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < printed.size(); ++i) {
    const Eigen::Vector3d off = 1e3 * (c.board_points[i] - printed[i]);
    low = low.cwiseMin(off);
    high = high.cwiseMax(off);
  }
  std::printf(
      "board's shape off its print x %+.3f to %+.3f, y %+.3f to %+.3f, z %+.3f to %+.3f mm\n",
      low.x(), high.x(), low.y(), high.y(), low.z(), high.z());
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

}  // namespace

void printResult(const StereoCalibration& c, const Board& board) {
  printViews(c);
  printLenses(c);
  std::printf("\n");
  printCamera("left camera", c.rig.left, c.uncertainty ? &c.uncertainty->left : nullptr);
  printCamera("right camera", c.rig.right.value(), c.uncertainty ? &c.uncertainty->right : nullptr);
  printPose(c);
  std::printf("\nviews used                  %zu, rejected %zu\n", c.used.size(),
              c.rejected.size());
  std::printf("reprojection RMS            %.4f px (corner noise %.4f px per axis)\n", c.rms_px,
              c.corner_sigma_px);
  std::printf("held-out vertical disparity %.4f px (%d folds)\n", c.heldout_vertical_disparity_px,
              c.folds);
  std::printf("baseline                    %.3f mm", 1e3 * baseline(c.rig));
  if (c.uncertainty) {
    const Eigen::Vector3d position = 1e3 * c.uncertainty->position_m;
    std::printf(" +- %.3f mm\n", 1e3 * c.uncertainty->baseline_m);
    std::printf("a point %.1f m away          +- %.2f %.2f %.2f mm in x y z of the left camera",
                kTypicalDistance_m, position.x(), position.y(), position.z());
  }
  std::printf("\n");
  printShape(c, board);
  std::printf("verdict: %s: %s\n", toString(c.verdict.grade).c_str(), c.verdict.sentence.c_str());
}

}  // namespace ringhook
