// Any bytes as the files of an EuRoC/ASL folder: cam0's data.csv and sensor.yaml, then cam1's, each
// parted from the one before by a line "=====".

#include <array>

#include "camera/sequence.h"
#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  static constexpr std::array kNames = {"asl/cam0/data.csv", "asl/cam0/sensor.yaml",
                                        "asl/cam1/data.csv", "asl/cam1/sensor.yaml"};
  const fuzz::ScratchFolder& folder = fuzz::scratch();
  for (const char* there : {"asl/cam0/data/1.png", "asl/cam1/data/1.png"}) {
    folder.write(there, "");
  }
  fuzz::writeFiles(folder, kNames, fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&folder] {
    const Sequence sequence = openSequence(folder.path() / "asl");
    fuzz::require(!sequence.frames.empty(), "a sequence has frames");
  });
}
