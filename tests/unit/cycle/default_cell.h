#pragma once

/// \file
/// The default simulated cell as text and as loaded, the ground that the tests of this folder vary.

#include <filesystem>
#include <string>

#include "cycle/cell_config.h"
#include "rig/stereo_rig.h"

namespace ringhook::test {

std::filesystem::path defaultCellFile();
std::string defaultCellText();
CellConfig defaultCell();

/// A cell's cameras with an eighth of their pixels per axis: maps are made faster.
StereoRig coarseRig(const CellConfig& cell);

}  // namespace ringhook::test
