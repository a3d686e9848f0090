#pragma once

/// \file
/// `ringhook simulate`: the simulated cell's devices for clients on a network.

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers the subcommand; its callback serves until Ctrl-C and throws Error on failure.
void addSimulateCommand(CLI::App& app);

}  // namespace ringhook
