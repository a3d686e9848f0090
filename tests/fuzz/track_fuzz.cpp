// Any bytes as a TUM or KITTI trajectory: what is understood lies nowhere from itself.

#include "evaluation/trajectory_compare.h"
#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const auto file = fuzz::scratch().write("track.txt", fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&file] {
    const PositionTrack track = readPositionTrack(file);
    fuzz::require(!track.positions.empty(), "a trajectory has positions");
    fuzz::require(track.times.size() == (track.timed ? track.positions.size() : 0),
                  "times are as many as positions, or none");
    const PositionPairs pairs = pairTracks(track, track, 0.0);
    fuzz::require(trackError(pairs, Alignment::kNone).max_m == 0.0, "it lies where it lies");
  });
}
