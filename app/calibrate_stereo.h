#pragma once

/// \file
/// `ringhook calibrate stereo`: two cameras and the pose between them from pictures of a board.

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers the step under `calibrate`.
void addCalibrateStereo(CLI::App& calibrate);

}  // namespace ringhook
