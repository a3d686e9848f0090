// Stereo pairs per second and memory of the simulated camera, with shadows, 4 samples a pixel,
// motion blur and noise:
//   sim_camera_bench [--pairs N]

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>

#include "sim/cell_world.h"
#include "sim/nominal_rig.h"
#include "sim/sim_stereo_camera.h"

namespace ringhook {
namespace {

struct Meter {
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< user and system time of all threads
};

Meter readMeter() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(now).count(),
          seconds(used.ru_utime) + seconds(used.ru_stime)};
}

double peakMemoryMiB() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_maxrss) / 1024.0;
}

/// The worst of the shipped scenes: clutter, textured wall, an occluder passing, hooks swinging.
CellOptions busyCell() {
  CellOptions options;
  options.belt.start_y = options.belt.entry_y = -0.1;
  options.hook.swing_about_x = options.hook.swing_about_y = 0.2;
  options.scene.wall = WallKind::textured;
  options.scene.clutter = 30;
  options.scene.occluder.count = 1;
  options.scene.occluder.first_s = 1.0;
  return options;
}

/// \param side of the window [px]; 0: the full image.
void measure(const char* name, const CellOptions& options, int side, int pairs) {
  constexpr double kRate = 50.0;
  CellWorld world(options);
  SimCameraOptions camera_options;
  camera_options.rate_hz = kRate;
  SimStereoCamera camera(world, nominalRig(), camera_options);
  const Window window{1024 - side / 2, 1100 - side / 2, side, side};
  camera.setWindows(window, window);
  world.advanceTo(Time::fromSeconds(2.0 / kRate));
  while (camera.grab(0.0)) {
  }
  CellWorld bare(options);
  const Meter idle = readMeter();
  bare.advanceTo(Time::fromSeconds(pairs / kRate));
  const Meter start = readMeter();
  world.advanceTo(Time::fromSeconds((2.0 + pairs) / kRate));
  const Meter end = readMeter();
  const double physics = start.wall_s - idle.wall_s;
  const double wall = end.wall_s - start.wall_s - physics;
  const double cpu = end.cpu_s - start.cpu_s - (start.cpu_s - idle.cpu_s);
  std::printf("%-28s %6.2f pairs/s  %7.1f ms/pair  CPU %7.1f ms/pair  (physics apart: %.1f ms)\n",
              name, pairs / wall, 1e3 * wall / pairs, 1e3 * cpu / pairs, 1e3 * physics / pairs);
}

void measureAll(int pairs) {
  const CellOptions plain;
  CellOptions unshadowed = busyCell();
  unshadowed.scene.light.shadows = false;
  measure("512 window, default cell", plain, 512, 4 * pairs);
  measure("512 window, busy cell", busyCell(), 512, 4 * pairs);
  measure("512 window, no shadows", unshadowed, 512, 4 * pairs);
  measure("2048 full, default cell", plain, 0, pairs);
  measure("2048 full, busy cell", busyCell(), 0, pairs);
  measure("2048 full, no shadows", unshadowed, 0, pairs);
  std::printf("peak memory %.0f MiB\n", peakMemoryMiB());
}

}  // namespace
}  // namespace ringhook

int main(int argc, char** argv) {
  CLI::App app("Stereo pairs per second and memory of the simulated camera");
  int pairs = 10;
  app.add_option("--pairs", pairs, "full pairs for each line; four times as many windows")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    ringhook::measureAll(pairs);
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << "\n";
    return 1;
  }
  return 0;
}
