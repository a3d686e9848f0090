#pragma once

/// \file
/// `ringhook calibrate verify`: does an accepted rig still hold?

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers the step under `calibrate`.
void addCalibrateVerify(CLI::App& calibrate);

}  // namespace ringhook
