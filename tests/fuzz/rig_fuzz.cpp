// Any bytes as a rig.yaml: a rig that is read passes its own check.

#include "rig/stereo_rig.h"

#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const auto file = fuzz::scratch().write("rig.yaml", fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&file] {
    const StereoRig rig = loadRig(file);
    try {
      checkRig(rig, "the rig");
    } catch (const InputError&) {
      fuzz::require(false, "a rig that is read passes its own check");
    }
  });
}
