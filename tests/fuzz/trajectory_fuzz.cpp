// Any bytes as a TUM trajectory: its times are ones of the clock, its poses finite.

#include <cmath>

#include "evaluation/trajectory_io.h"
#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const auto file = fuzz::scratch().write("trajectory.txt", fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&file] {
    const std::vector<StampedPose> poses = readTum(file);
    fuzz::require(!poses.empty(), "a trajectory has poses");
    for (const StampedPose& pose : poses) {
      fuzz::require(std::abs(pose.time.seconds()) < 9.1e9, "a time is one that was told");
      fuzz::require(pose.pose.matrix().allFinite(), "a pose is finite");
    }
  });
}
