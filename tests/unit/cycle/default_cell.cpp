#include "default_cell.h"

#include <fstream>
#include <sstream>

namespace ringhook::test {

std::filesystem::path defaultCellFile() { return RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml"; }

std::string defaultCellText() {
  std::ostringstream text;
  text << std::ifstream(defaultCellFile()).rdbuf();
  return text.str();
}

CellConfig defaultCell() { return loadCellConfig(defaultCellFile()); }

}  // namespace ringhook::test
