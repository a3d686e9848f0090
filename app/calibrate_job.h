#pragma once

/// \file
/// What the steps of `ringhook calibrate` have in common.

#include <string>

#include "app/progress.h"

namespace ringhook {

/// Now, as in 2026-11-22T15:04:05Z: the date of a result.
std::string utcDate();

}  // namespace ringhook
