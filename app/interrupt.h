#pragma once

/// \file
/// Ctrl-C and SIGTERM set a flag; long jobs look at it between steps, stop the arm first, keep
/// what they have, and end. A second signal ends the program at once.

#include <atomic>

namespace ringhook {

/// Installs the handlers; called once by main.
void catchInterrupts();

/// True once the operator asked to stop.
const std::atomic<bool>& interruptRequested();

}  // namespace ringhook
