// Any bytes as a .cao model.

#include "tracking/edge_model.h"

#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const auto file = fuzz::scratch().write("model.cao", fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&file] { static_cast<void>(loadEdgeModel(file)); });
}
