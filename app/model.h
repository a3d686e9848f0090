#pragma once

/// \file
/// `ringhook model`: from numbers or from a CAD mesh to the models that the trackers use.

#include <CLI/CLI.hpp>

namespace ringhook {

void addModelCommand(CLI::App& app);

}  // namespace ringhook
