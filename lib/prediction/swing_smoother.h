#pragma once

/// \file
/// The best estimate afterwards: every instant given all measurements, the later ones too. The
/// offline reference beside which a filter's causal estimates are judged where there is no truth.
/// Fixed-interval smoother of Rauch, Tung and Striebel (AIAA Journal 3, 1965):
///   C = P_k Phi^T P-_{k+1}^-1,  x = x_k + C (x_{k+1} - x-_{k+1}),
///   P = P_k + C (P_{k+1} - P-_{k+1}) C^T
/// on an extended filter that runs forwards from the batch fit of all measurements, so that the law
/// is linearised along the right path from the beginning.

#include <span>
#include <vector>

#include "core/outcome.h"
#include "prediction/swing_replay.h"

namespace ringhook {

/// Belief at every measurement given them all. `changing`: the pivot's speed may change at any time
/// (SwingMode::kChanging), else it travels evenly. Measurements beyond the gate are left out.
/// Refuses what fitSwing() refuses.
Outcome<std::vector<SwingBelief>> smoothSwing(std::span<const SwingMeasurement> measurements,
                                              const SwingFilterOptions& options, SwingMode mode);

}  // namespace ringhook
