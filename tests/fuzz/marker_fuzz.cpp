// Any bytes as a marker.yaml.

#include "tracking/tag_plate.h"

#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const auto file = fuzz::scratch().write("marker.yaml", fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&file] { static_cast<void>(loadTagPlate(file)); });
}
