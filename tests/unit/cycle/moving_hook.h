#pragma once

/// \file
/// A hook on the belt in closed form: the pivot travels evenly, the hook swings harmonically about
/// both axes. The truth of the task's tests.

#include "core/hook_values.h"
#include "cycle/cell_config.h"

namespace ringhook::test {

struct MovingHook {
  double travel_m = -0.5;   ///< of the pivot at time 0
  double speed_m_s = 0.05;  ///< of the pivot along the belt
  double swing_rad = 0.05;  ///< amplitude about x; about y six tenths of it

  /// fMo at `time`.
  [[nodiscard]] Pose at(const CellConfig& cell, Time time) const;
  /// What a perfect camera at `fMc1` would say.
  [[nodiscard]] HookFix fix(const CellConfig& cell, const Pose& fMc1, Time time) const;
};

}  // namespace ringhook::test
