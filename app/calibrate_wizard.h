#pragma once

/// \file
/// `ringhook calibrate wizard`: the guided set-up of a cell.

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers the wizard under `calibrate`.
void addCalibrateWizard(CLI::App& calibrate);

}  // namespace ringhook
