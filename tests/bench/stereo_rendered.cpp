// A rig calibrated from pictures that the simulated cell renders, against the truth:
//   stereo_rendered --views 25 --seed 1 [--out DIR]

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iostream>

#include "../unit/calib/cell_views.h"
#include "calib/solve/stereo_calibration.h"
#include "camera/image_file.h"
#include "core/error.h"

namespace ringhook {
namespace {

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Pictures {
  StereoViews views;
  double finding_cpu_s = 0.0;
};

Pictures take(int count, std::uint64_t seed, const std::filesystem::path& out) {
  Pictures pictures;
  renderViews(workspaceBoard(), count, seed, seed, [&](int i, const StereoFrame& frame) {
    const std::string number = std::to_string(100 + i).substr(1) + ".png";
    if (!out.empty()) {
      writeGrayImage(out / ("left" + number), frame.left);
      writeGrayImage(out / ("right" + number), frame.right);
    }
    const double start = cpuSeconds();
    const auto left = findBoard(frame.left, workspaceBoard());
    const auto right = findBoard(frame.right, workspaceBoard());
    pictures.finding_cpu_s += cpuSeconds() - start;
    if (left && right) {
      pictures.views.usable.push_back({"left" + number, "right" + number, frame.left.width,
                                       frame.left.height, *left,
                                       orderedLike(*left, *right, workspaceBoard())});
    } else {
      pictures.views.rejected.push_back(
          {"left" + number, "right" + number,
           left ? "right: " + right.reason() : "left: " + left.reason()});
    }
  });
  return pictures;
}

void compareLens(const char* name, const CameraModel& found, const CameraModel& truth) {
  for (const int axis : {0, 1}) {
    const double error = found.K(axis, axis) / truth.K(axis, axis) - 1.0;
    std::printf("%-5s f%c        %9.3f px, true %9.3f px   %+.4f %%\n", name, axis == 0 ? 'x' : 'y',
                found.K(axis, axis), truth.K(axis, axis), 100.0 * error);
  }
}

void compareBar(const StereoRig& found, const StereoRig& truth, std::uint64_t seed) {
  constexpr int kPictures = 20;
  const auto rms_mm = [](const std::vector<double>& errors) {
    double sum = 0.0;
    for (const double e : errors) {
      sum += e * e;
    }
    return 1e3 * std::sqrt(sum / static_cast<double>(errors.size()));
  };
  const std::vector<double> errors = renderedBarErrors(found, kPictures, seed);
  std::printf(
      "200 mm between corners of another board in %d new pictures, %zu lengths, RMS error:\n",
      kPictures, errors.size());
  std::printf("  as found in the pictures                         %.4f mm   (true rig %.4f mm)\n",
              rms_mm(errors), rms_mm(renderedBarErrors(truth, kPictures, seed)));
}

void compare(const StereoCalibration& c, std::uint64_t seed) {
  const StereoRig truth = trueCellRig(seed);
  for (const RejectedView& view : c.rejected) {
    std::printf("%s rejected: %s\n", view.left_name.c_str(), view.reason.c_str());
  }
  std::printf("views %zu, distortion terms %d, RMS %.4f px, corner noise %.4f px per axis\n",
              c.used.size(), static_cast<int>(c.terms), c.rms_px, c.corner_sigma_px);
  std::printf("held-out vertical disparity %.4f px\n", c.heldout_vertical_disparity_px);
  compareLens("left", c.rig.left, truth.left);
  compareLens("right", *c.rig.right, *truth.right);
  std::printf("baseline        %9.4f mm, true %9.4f mm   %+.4f %%", 1e3 * baseline(c.rig),
              1e3 * baseline(truth), 100.0 * (baseline(c.rig) / baseline(truth) - 1.0));
  if (c.uncertainty) {
    std::printf("   (sigma %.4f mm; focal lengths %.3f px)", 1e3 * c.uncertainty->baseline_m,
                c.uncertainty->focal_px);
  }
  std::printf("\n");
  compareBar(c.rig, truth, seed);
  std::printf("200 mm bar, RMS error of its length, 500 places, all directions:\n");
  std::printf("  exact images: the calibration alone              %.4f mm\n",
              1e3 * barError(c.rig, truth, 0.0, seed));
  for (const double corner_px : {0.035, 0.05}) {
    std::printf("  ends are tags' middles, %.3f px a corner         %.4f mm   (true rig %.4f mm)\n",
                corner_px, 1e3 * barError(c.rig, truth, 0.5 * corner_px, seed),
                1e3 * barError(truth, truth, 0.5 * corner_px, seed));
  }
  std::printf("verdict: %s: %s\n", toString(c.verdict.grade).c_str(), c.verdict.sentence.c_str());
}

}  // namespace
}  // namespace ringhook

int main(int argc, char** argv) {
  using namespace ringhook;
  CLI::App app("A rig calibrated from rendered pictures, against the truth");
  int views = 25;
  std::uint64_t seed = 1;
  std::filesystem::path out;
  app.add_option("--views", views, "pairs of pictures")->check(CLI::Range(4, 99));
  app.add_option("--seed", seed, "of cell, cameras and places of the board");
  app.add_option("--out", out, "folder for the pictures")->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  try {
    const Pictures pictures = take(views, seed, out);
    const double start = cpuSeconds();
    const StereoCalibration c = calibrateStereo(pictures.views, workspaceBoard(), StereoOptions{},
                                                [](double, const std::string&) {});
    const double fitting = cpuSeconds() - start;
    compare(c, seed);
    std::printf("CPU time: finding the board %.1f s, calibrating %.1f s\n", pictures.finding_cpu_s,
                fitting);
  } catch (const Error& e) {
    std::cerr << "stereo_rendered: " << e.what() << "\n";
    return e.exitCode();
  }
  return 0;
}
