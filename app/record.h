#pragma once

/// \file
/// `ringhook record`: a sequence from any cell.

#include <CLI/CLI.hpp>

namespace ringhook {

/// Registers the subcommand; its callback runs the job and throws Error on failure.
void addRecordCommand(CLI::App& app);

}  // namespace ringhook
