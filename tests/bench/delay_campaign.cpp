/// \file
/// `calibrate time` in simulated cells of many seeds, each with delays of its own that the
/// estimator is not told, printed beside what it found:
///   delay_campaign --seeds 8
/// Exits with 1 if a delay is more than 0.3 ms off, or if one was refused.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "calib/wizard/place_delays.h"
#include "sim/nominal_rig.h"

namespace ringhook {
namespace {

struct Delays {
  double camera_s = 0.0;
  double arm_s = 0.0;
};

/// 4 to 20 ms for the cameras, 0 to 12 ms for the arm.
Delays delaysOfSeed(std::uint64_t seed) {
  std::mt19937_64 bits(1000 + seed);
  const auto share = [&] { return static_cast<double>(bits() >> 11U) * 0x1p-53; };
  const double camera_s = 0.004 + 0.016 * share();
  return {camera_s, 0.012 * share()};
}

/// Largest error of the two [s]; infinite if nothing was found.
double run(const CellConfig& cell, std::uint64_t seed, double seconds) {
  const Delays truth = delaysOfSeed(seed);
  SimulatedPlaceOptions options;
  options.seed = seed;
  options.camera_delay_s = truth.camera_s;
  options.arm_delay_s = truth.arm_s;
  const auto place = openSimulatedPlace(cell, options);
  WiggleOptions wiggle;
  wiggle.seconds = seconds;
  const auto record = recordWiggle(*place, cell, nominalRig(), loadTagPlate(cell.arm.gripper_plate),
                                   wiggle, [](double, const std::string&) {});
  const auto found =
      record ? delaysOf(*record, nominalRig()) : Outcome<DelayReport>(Refusal{record.reason()});
  if (!found || !found->camera || !found->robot || !found->response) {
    std::printf("%4d %9.3f %9s %9.3f %9s  %s\n", static_cast<int>(seed), 1e3 * truth.camera_s, "-",
                1e3 * truth.arm_s, "-", found ? "not both" : found.reason().c_str());
    return std::numeric_limits<double>::infinity();
  }
  std::printf("%4d %9.3f %9.3f %9.3f %9.3f %9.3f %9.3f %9.3f %9.3f\n", static_cast<int>(seed),
              1e3 * truth.camera_s, 1e3 * found->camera->value_s, 1e3 * truth.arm_s,
              1e3 * found->robot->value_s, 1e3 * found->robot->sigma_s,
              1e3 * found->response->delay_s, found->offset.rms_px, found->offset.rms_without_px);
  std::fflush(stdout);
  return std::max(std::abs(found->camera->value_s - truth.camera_s),
                  std::abs(found->robot->value_s - truth.arm_s));
}

}  // namespace
}  // namespace ringhook

int main(int argc, char** argv) {
  int seeds = 8;
  double seconds = 8.0;
  CLI::App app{"Delays of simulated cells, found and true; exits with 1 beyond 0.3 ms."};
  app.add_option("--seeds", seeds, "cells")->check(CLI::Range(1, 10000));
  app.add_option("--seconds", seconds, "of each wiggle")->check(CLI::Range(3.0, 120.0));
  CLI11_PARSE(app, argc, argv);
  try {
    const ringhook::CellConfig cell =
        ringhook::loadCellConfig(RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml");
    std::printf("%4s %9s %9s %9s %9s %9s %9s %9s %9s\n", "seed", "camera_ms", "found_ms", "arm_ms",
                "found_ms", "sigma_ms", "answer_ms", "rms_px", "rms_0_px");
    double worst = 0.0;
    for (int seed = 1; seed <= seeds; ++seed) {
      worst = std::max(worst, ringhook::run(cell, static_cast<std::uint64_t>(seed), seconds));
    }
    std::printf("largest error of %d cells: %.3f ms\n", seeds, 1e3 * worst);
    return worst < 0.0003 ? 0 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "delay_campaign: %s\n", e.what());
    return 2;
  }
}
