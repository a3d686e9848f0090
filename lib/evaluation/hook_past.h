#pragma once

/// \file
/// Where the simulated hooks were in the last second, for the truth of frames that arrive later
/// than they were exposed. Between instants, a millisecond apart, poses are interpolated: at 5
/// m/s^2 that errs by less than a micrometre.

#include <deque>
#include <optional>
#include <vector>

#include "core/pose.h"
#include "core/stereo_frame.h"
#include "rig/stereo_rig.h"

namespace ringhook {

class CellWorld;

class HookPast {
 public:
  /// Watches the world from now on; both must outlive the world's last step. `true_rig` as for the
  /// simulated camera.
  HookPast(CellWorld& world, const StereoRig& true_rig);
  HookPast(const HookPast&) = delete;
  HookPast& operator=(const HookPast&) = delete;

  /// The true hook in the true left camera at the frame's time: of those whose plate or whose arc
  /// is in view, the one whose plate is nearest to the middle of the left window. Nothing if none
  /// is in view, or if the frame is older than what is remembered.
  [[nodiscard]] std::optional<Pose> c1Mo(const StereoFrame& frame) const;

 private:
  struct Instant {
    Time time;
    std::vector<Pose> c1Mo;  ///< of each hook
  };

  StereoRig rig_;
  std::deque<Instant> past_;  ///< oldest first
};

}  // namespace ringhook
