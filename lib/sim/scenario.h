#pragma once

/// \file
/// Named simulated cells, as YAML: what app/config/scenarios/*.yaml hold. Units are in the keys
/// (_m, _deg, _m_s ...); a key left out keeps the default of CellOptions; an unknown one is
/// refused.
///
///     name: easy
///     belt: {speed_m_s: 0.05, speed_spread: 0.02}
///     hook: {count: 3, swing_about_x_deg: 3.0}
///     ring: {clearance_m: 0.013}

#include <filesystem>
#include <string>

#include "sim/cell_options.h"

namespace ringhook {

struct Scenario {
  std::string name;
  CellOptions cell;
};

/// Throws InputError naming file, line and field.
Scenario loadScenario(const std::filesystem::path& path);

}  // namespace ringhook
