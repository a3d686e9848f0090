// Any bytes as the files of another program: the first byte chooses the format; a rig that is read
// passes its own check and can be told in that format again, or not at all.

#include "calib/exchange/exchange.h"

#include <array>

#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  if (size == 0) {
    return 0;
  }
  constexpr std::array kFormats{RigFormat::kOpenCv, RigFormat::kVisp, RigFormat::kRos,
                                RigFormat::kKalibr};
  constexpr std::array kNames{"first.xml", "second.xml", "third.txt"};
  const RigFormat format = kFormats[data[0] % kFormats.size()];
  const auto files = fuzz::filesIn(fuzz::textOf(data + 1, size - 1));
  std::vector<std::filesystem::path> paths;
  for (std::size_t i = 0; i < std::min(files.size(), kNames.size()); ++i) {
    paths.push_back(fuzz::scratch().write(kNames[i], files[i]));
  }
  return fuzz::understoodOrRefused([&] {
    const StereoRig rig = importRig(format, paths, {640, 480, {}});
    checkRig(rig, "the rig");
    static_cast<void>(exportRig(format, rig));
  });
}
