#pragma once

/// \file
/// Angles are radians everywhere but in files and words for people.

#include <numbers>

namespace ringhook {

/// One degree [rad]: 30 * kDegree is an angle, angle / kDegree its number of degrees.
inline constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace ringhook
