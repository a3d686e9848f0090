#pragma once

/// \file
/// The hook as the swing filter sees it: options and priors from what is known of the cell, fixes
/// as measurements of a pose, beliefs as estimates of the hook, and what one hook teaches about the
/// next of its kind.

#include "core/hook_values.h"
#include "prediction/hook_model.h"
#include "prediction/swing_filter.h"

namespace ringhook {

/// Options of the swing filter for a hook of which only CAD and cell are known.
SwingFilterOptions swingOptions(const HookFilterOptions& options);

/// The same after a hook of the same kind was followed and `learnt` believed at its end: length,
/// friction and the speed of a running belt carry over, with the spread from hook to hook added. If
/// the next hook contradicts that, the filter goes back to what it would have believed without.
SwingFilterOptions swingOptionsAfter(const HookFilterOptions& options, const SwingBelief& learnt);

/// A fix with the noise floors that every fix shares.
SwingMeasurement swingMeasurement(const HookFix& fix, const HookFilterOptions& options);

/// Pose, velocity and covariance at o that the belief stands for.
HookEstimate swingEstimate(const SwingBelief& belief, Time time, const HookFilterOptions& options);

}  // namespace ringhook
