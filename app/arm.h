#pragma once

/// \file
/// `ringhook arm`: an RX60 looked at and moved by hand, to bring a cell into service step by step
/// (doc/rx60.md): watch, power, move, jog, gripper.

#include <CLI/CLI.hpp>

namespace ringhook {

void addArmCommand(CLI::App& app);

}  // namespace ringhook
