// Robot-camera calibration in the simulated cell, from rendered pictures of the gripper's plate:
// the eight corners of a cube as in the 2007 report, and poses all around.
//   robot_camera_rendered --seeds 5 --poses 30

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "../unit/calib_robot/rendered_cell.h"
#include "calib/solve/joint_zeros.h"
#include "core/angle.h"
#include "core/error.h"

namespace ringhook {
namespace {

double positionError(const Pose& a, const Pose& b) {
  return 1e3 * (a.translation() - b.translation()).norm();
}

double angleError(const Pose& a, const Pose& b) {
  return thetaU(a.linear().transpose() * b.linear()).norm() / kDegree;
}

void printZeros(const JointZeros& zeros, const JointVector& truth) {
  std::printf("        joint zeros, found, sigma, true [deg]:");
  for (int k = 1; k < 5; ++k) {  // those of joints 1 and 6 are camera and plate
    std::printf("  %.4f %.4f %.4f", zeros.zero_rad[k] / kDegree, zeros.sigma_rad[k] / kDegree,
                truth[k] / kDegree);
  }
  std::printf("\n");
}

void printViews(const RenderedCell& cell, const std::vector<PlateView>& views, unsigned seed,
                ZeroChoice choice) {
  const PlateCalibration c =
      calibrateFromViews(views, EyeSetup::kEyeToHand, choice, [](double, const std::string&) {});
  const HandEyeResult& r = c.result;
  std::printf(
      "seed %u  %zu poses, zeros %s: residual %.3f mm %.4f deg, held out %.3f mm (%.3f per axis), "
      "corners %.3f px, %.3f px with a perfect arm, rejected %zu, %s\n",
      seed, views.size(), c.zeros_used ? "corrected" : "kept", 1e3 * r.residual.translation_m,
      r.residual.rotation_rad / kDegree, 1e3 * r.heldout.translation_m,
      1e3 * r.heldout.translation_m / std::sqrt(3.0), c.rms_px, c.arm_rms_px, r.rejected.size(),
      r.verdict.sentence.c_str());
  std::printf("        camera off by %.3f mm %.4f deg, plate off by %.3f mm %.4f deg\n",
              positionError(r.pose.camera, cell.trueCamera()),
              angleError(r.pose.camera, cell.trueCamera()),
              positionError(r.pose.target, RenderedCell::trueTarget()),
              angleError(r.pose.target, RenderedCell::trueTarget()));
  std::printf("        ring where it meets hooks off by %.3f mm RMS; said: %.3f mm\n",
              1e3 * cell.ringError(r.pose.camera, c.arm_zeros_rad),
              r.sigmas ? 1e3 * r.sigmas->workspace_m : 0.0);
  if (c.zeros_used) {
    printZeros(*c.zeros, cell.trueZeros());
  }
  std::fflush(stdout);
}

void runSeed(unsigned seed, int poses, double side_m) {
  RenderedCell cell(seed);
  const PointFit cube = fitPoints(RenderedCell::pointsOf(cell.cube(side_m)));
  std::printf(
      "seed %u  cube of %.0f mm: residual %.3f mm, held out %.3f mm, axes %.3f %.3f %.3f mm, "
      "%s, camera off by %.3f mm %.4f deg\n",
      seed, 1e3 * side_m, 1e3 * cube.residual_m, 1e3 * cube.heldout_m, 1e3 * cube.axis_rms_m.x(),
      1e3 * cube.axis_rms_m.y(), 1e3 * cube.axis_rms_m.z(), toString(cube.verdict.grade).c_str(),
      positionError(cube.fMc1, cell.trueCamera()), angleError(cube.fMc1, cell.trueCamera()));
  const auto views = cell.around(poses, seed);
  for (const ZeroChoice choice : {ZeroChoice::kKeep, ZeroChoice::kWherePaying}) {
    printViews(cell, views, seed, choice);
  }
}

}  // namespace
}  // namespace ringhook

int main(int argc, char** argv) {
  CLI::App app("Robot-camera calibration from rendered pictures of the simulated cell.");
  unsigned seeds = 5;
  int poses = 30;
  double side_mm = 200.0;
  app.add_option("--seeds", seeds, "how many cells")->capture_default_str();
  app.add_option("--poses", poses, "views all around")->capture_default_str();
  app.add_option("--cube", side_mm, "side of the cube [mm]")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const std::clock_t start = std::clock();
  try {
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      ringhook::runSeed(seed, poses, 1e-3 * side_mm);
    }
  } catch (const ringhook::Error& e) {
    std::fprintf(stderr, "robot_camera_rendered: %s\n", e.what());
    return e.exitCode();
  }
  std::printf("CPU time %.1f s\n",
              static_cast<double>(std::clock() - start) / static_cast<double>(CLOCKS_PER_SEC));
  return 0;
}
