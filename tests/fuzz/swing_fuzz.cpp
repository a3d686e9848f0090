// Any bytes as a trajectory.csv, with times of its own or at a told rate: what is understood has
// samples of one size, finite, in growing time, and a noise.

#include <cmath>

#include "evaluation/sample_noise.h"
#include "evaluation/trajectory_file.h"
#include "fuzz/scratch_folder.h"

namespace {

void requireWhole(const ringhook::Trajectory& trajectory) {
  using namespace ringhook;
  fuzz::require(trajectory.values.size() > 1, "a trajectory has samples");
  fuzz::require(trajectory.times.size() == trajectory.values.size(), "each sample has a time");
  for (std::size_t i = 0; i < trajectory.values.size(); ++i) {
    fuzz::require(trajectory.values[i].size() == valueSize(trajectory.kind), "sizes are alike");
    fuzz::require(trajectory.values[i].allFinite(), "a sample is finite");
    fuzz::require(i == 0 || trajectory.times[i] > trajectory.times[i - 1], "time grows");
  }
  const double noise = estimateSampleNoise(trajectory);
  fuzz::require(std::isfinite(noise) && noise > 0.0, "a noise is a number above 0");
  fuzz::require(repeatedSamples(trajectory) < trajectory.values.size(), "one sample is fresh");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const auto file = fuzz::scratch().write("swing.csv", fuzz::textOf(data, size));
  fuzz::understoodOrRefused([&file] { requireWhole(readTrajectory(file, {})); });
  return fuzz::understoodOrRefused([&file] { requireWhole(readTrajectory(file, {{}, 29.3})); });
}
