#pragma once

/// \file
/// The subcommand `ringhook evaluate experiment`: the 2007 report's experiments, repeated.

#include <CLI/CLI.hpp>

namespace ringhook {

void addExperimentCommand(CLI::App& evaluate);

}  // namespace ringhook
