#pragma once

/// \file
/// Mishaps on the controller's side of the wire, dealt out: what was done, and what the arm must do
/// about it.

#include <optional>
#include <random>

#include "arm_mishaps.h"
#include "sim/controller_port.h"

namespace ringhook::test {

inline constexpr double kStopWithin = 0.020;  ///< after which the commanded speed must be zero [s]

/// When the commanded speed must be zero: from `since` on, after `grace_s` at the latest.
struct MustStand {
  Time since;
  double grace_s = kStopWithin;
  double lasts_s = 1e9;    ///< the reason to stand ends by itself
  double longest_s = 0.0;  ///< how long after `since` it was last seen moving
};

/// What a mishap that was dealt out asks of the arm.
struct DealtMishap {
  std::optional<MustStand> stand;
  double in_flight_s = 0.0;  ///< how late a command may still arrive [s]
};

/// Deals what concerns the controller and the lines; others are left alone.
DealtMishap dealMishap(Mishap mishap, Rx60Controller& controller, ControllerPort& port,
                       std::mt19937_64& random);

/// Everything as it should be, except for connections, which the client must open again.
void mendMishaps(Rx60Controller& controller, ControllerPort& port);

}  // namespace ringhook::test
