#pragma once

/// \file
/// What is left of a velocity target that has grown old: all of it while it is held, then linearly
/// less, then nothing. Vision at 50 Hz feeds control at 250 Hz without steps, and an arm whose
/// vision has died comes to rest by itself.

#include <algorithm>

namespace ringhook::rx60 {

/// Share of the target, 1 to 0, at `age_s` [s]. Precondition: ramp_s >= 0.
inline double heldShare(double age_s, double hold_s, double ramp_s) {
  if (age_s <= hold_s) {
    return 1.0;
  }
  return ramp_s > 0.0 ? std::max(0.0, 1.0 - (age_s - hold_s) / ramp_s) : 0.0;
}

}  // namespace ringhook::rx60
