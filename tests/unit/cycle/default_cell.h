#pragma once

/// \file
/// The default simulated cell as text and as loaded, the ground that the tests of this folder vary.

#include <filesystem>
#include <string>

#include "cycle/cell_config.h"

namespace ringhook::test {

std::string textOf(const std::filesystem::path& file);
std::filesystem::path defaultCellFile();
std::string defaultCellText();
CellConfig defaultCell();

}  // namespace ringhook::test
