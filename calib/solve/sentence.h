#pragma once

/// \file
/// Numbers in sentences, in the units people read.

#include <array>
#include <cstdio>
#include <string>

#include "core/angle.h"

namespace ringhook {

/// A number with so many decimals: decimals(3.14159, 2) is "3.14".
inline std::string decimals(double value, int digits) {
  std::array<char, 340> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

/// A length in millimetres with its unit.
inline std::string millimetres(double metres) { return decimals(1e3 * metres, 2) + " mm"; }

/// An angle in degrees with its unit.
inline std::string degrees(double radians) { return decimals(radians / kDegree, 2) + " degrees"; }

}  // namespace ringhook
