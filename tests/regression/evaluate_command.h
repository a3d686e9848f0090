#pragma once

/// \file
/// Runs `ringhook evaluate ...` as the program does, in this process, with its exit code.

#include <filesystem>
#include <string>
#include <vector>

namespace ringhook {

struct CommandResult {
  int exit_code = 0;
  std::string message;  ///< the one sentence of a failure
};

/// \param arguments behind `ringhook evaluate`.
CommandResult runEvaluate(std::vector<std::string> arguments);

/// Number of files below a folder; 0 if it does not exist.
int filesBelow(const std::filesystem::path& folder);

}  // namespace ringhook
