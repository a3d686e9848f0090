#pragma once

/// \file
/// `ringhook calibrate ...`: the set-up of a cell, step by step and without prompts.

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers the subcommand. Its callbacks run the job and throw Error on failure.
void addCalibrateCommand(CLI::App& app);

}  // namespace ringhook
