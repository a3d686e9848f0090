#pragma once

/// \file
/// A hook of the simulated physics, seen with noise: the independent truth of the swing filter's
/// tests.

#include <random>
#include <vector>

#include "prediction/hook_swing.h"
#include "sim/hook_world.h"

namespace ringhook {

constexpr double kTrialFrame = 0.02;  // [s]

/// A state in which nothing is zero and no two axes are alike.
SwingVector anyState();

/// Options of a world in which a hook with usual friction swings by 5 degrees below a belt.
HookWorldOptions usualHook();

/// What is known of that hook from CAD.
HookFilterOptions usualKnowledge();

/// Every frame's pose with 0.2 mm and 1 mrad of noise.
std::vector<SwingMeasurement> seenPoses(const std::vector<HookWorldSample>& truth, unsigned seed);

/// RMS per coordinate of o predicted 0.3 s ahead, over frames [first, end) [m]. The filter is given
/// all measurements before `end`.
double missedAhead(SwingFilter& filter, const std::vector<SwingMeasurement>& seen,
                   const std::vector<HookWorldSample>& truth, std::size_t first, std::size_t end);

}  // namespace ringhook
