// Any bytes as a cell file.

#include "cycle/cell_config.h"

#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const auto file = fuzz::scratch().write("cell.yaml", fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&file] { static_cast<void>(loadCellConfig(file)); });
}
