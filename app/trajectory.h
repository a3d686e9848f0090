#pragma once

/// \file
/// The subcommands of `ringhook evaluate` that are about trajectories: `trajectory`, how well it
/// can be predicted, and `compare`, how far one lies from another.

#include <CLI/CLI.hpp>

namespace ringhook {

void addTrajectoryCommand(CLI::App& evaluate);
void addCompareCommand(CLI::App& evaluate);

}  // namespace ringhook
