#pragma once

/// \file
/// `ringhook evaluate`: the offline jobs of a researcher.

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers `evaluate` with its sub-subcommands; a chosen one runs when the line is parsed and
/// throws Error on failure.
void addEvaluateCommand(CLI::App& app);

}  // namespace ringhook
