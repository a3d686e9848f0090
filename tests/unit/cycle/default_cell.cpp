#include "default_cell.h"

#include <fstream>
#include <sstream>

namespace ringhook::test {

std::string textOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::filesystem::path defaultCellFile() { return RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml"; }

std::string defaultCellText() { return textOf(defaultCellFile()); }

CellConfig defaultCell() { return loadCellConfig(defaultCellFile()); }

}  // namespace ringhook::test
