#pragma once

/// \file
/// `ringhook calibrate time`: how late cameras and arm tell what they saw, from a small motion that
/// both watch.

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers the step under `calibrate`.
void addCalibrateTime(CLI::App& calibrate);

}  // namespace ringhook
