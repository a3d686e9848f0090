#pragma once

/// \file
/// `ringhook calibrate import` and `ringhook calibrate export`: rigs from and to other programs.

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers both steps under `calibrate`.
void addCalibrateExchange(CLI::App& calibrate);

}  // namespace ringhook
