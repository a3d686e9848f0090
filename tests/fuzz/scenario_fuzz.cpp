// Any bytes as a scenario of the simulated cell.

#include "sim/scenario.h"

#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const auto file = fuzz::scratch().write("scenario.yaml", fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&file] { static_cast<void>(loadScenario(file)); });
}
