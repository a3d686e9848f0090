#pragma once

/// \file
/// Numbers as text in tables that must lose nothing: reading them back gives the same bits.

#include <string>

#include "core/time.h"

namespace ringhook {

/// The shortest decimal text that reads back as the same double.
std::string exactText(double value);

/// Seconds with nine decimals, made from the whole number of nanoseconds.
std::string secondsText(Time time);

}  // namespace ringhook
