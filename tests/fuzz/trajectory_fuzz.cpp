// Any bytes as a TUM trajectory: what is read writes and reads back.

#include "evaluation/trajectory_io.h"
#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const auto file = fuzz::scratch().write("trajectory.txt", fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&file] {
    const std::vector<StampedPose> poses = readTum(file);
    fuzz::require(!poses.empty(), "a trajectory has poses");
    for (const StampedPose& pose : poses) {
      fuzz::require(pose.pose.matrix().allFinite(), "a pose is finite");
    }
  });
}
