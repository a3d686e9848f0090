#pragma once

/// \file
/// `ringhook calibrate plan`: what a stereo rig will be able to measure, before it is built.

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers the step under `calibrate`.
void addCalibratePlan(CLI::App& calibrate);

}  // namespace ringhook
