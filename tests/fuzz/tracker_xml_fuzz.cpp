// Any bytes as ViSP's settings of an edge tracker.

#include "tracking/edge_settings.h"

#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const auto file = fuzz::scratch().write("tracker.xml", fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&file] { static_cast<void>(loadEdgeSettings(file)); });
}
