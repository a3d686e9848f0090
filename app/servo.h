#pragma once

/// \file
/// `ringhook servo`: the operator's task.

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers the subcommand; its callback runs the job and throws Error on failure.
void addServoCommand(CLI::App& app);

}  // namespace ringhook
