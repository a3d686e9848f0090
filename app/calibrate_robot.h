#pragma once

/// \file
/// `ringhook calibrate robot`: where the camera stands in the robot's reference, or on its flange.

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers the step under `calibrate`.
void addCalibrateRobot(CLI::App& calibrate);

}  // namespace ringhook
