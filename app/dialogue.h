#pragma once

/// \file
/// Commands that ask the integrator: the terminal as the wizard's console, and Ctrl-C as the wish
/// to leave.

#include <string>

#include "calib/solve/stereo_problem.h"
#include "calib/wizard/console.h"

namespace ringhook {

/// Standard input and output; leaveIfAsked while an answer is waited for.
Console terminal();

/// Throws Interrupted once Ctrl-C was pressed.
void leaveIfAsked();

/// A progress line of its own for a long computation; the hook keeps it alive.
StepHook progressOf(const std::string& what);

}  // namespace ringhook
