#pragma once

/// \file
/// The reason of a refusal as text to compare with; "taken" for a value.

#include <string>

#include "core/outcome.h"

namespace ringhook {

template <class T>
std::string reasonOf(const Outcome<T>& outcome) {
  return outcome ? "taken" : outcome.reason();
}

}  // namespace ringhook
