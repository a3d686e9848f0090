// Any bytes as the files of a sequence folder: sequence.yaml, frames.csv, truth.csv, robot.csv,
// each parted from the one before by a line "=====".

#include "camera/sequence.h"

#include <array>

#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  static constexpr std::array kNames = {"own/sequence.yaml", "own/frames.csv", "own/truth.csv",
                                        "own/robot.csv"};
  const fuzz::ScratchFolder& folder = fuzz::scratch();
  for (const char* there : {"own/rig.yaml", "own/left.png", "own/right.png"}) {
    folder.write(there, "");
  }
  fuzz::writeFiles(folder, kNames, fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&folder] {
    const Sequence sequence = openSequence(folder.path() / "own");
    fuzz::require(!sequence.frames.empty(), "a sequence has frames");
    for (std::size_t i = 1; i < sequence.frames.size(); ++i) {
      fuzz::require(sequence.frames[i].time > sequence.frames[i - 1].time, "time grows");
    }
  });
}
