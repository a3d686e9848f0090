#pragma once

/// \file
/// The one interface of every way to see the hook: rectified images in, features with their model
/// geometry out. Implementations: AprilTag plate (marker), ViSP's model-based edge tracker.

#include <optional>

#include "core/hook_values.h"
#include "core/outcome.h"
#include "core/stereo_frame.h"

namespace ringhook {

class HookTracker {
 public:
  HookTracker() = default;
  HookTracker(const HookTracker&) = delete;
  HookTracker& operator=(const HookTracker&) = delete;
  virtual ~HookTracker() = default;

  /// Finds the hook in one or two views. `c1Mo_predicted` is where prediction expects it; a tracker
  /// that needs a start refuses ("no start pose") without it. After a refusal the tracker is
  /// ready for the next call. Throws Error only for broken models or third-party failures.
  [[nodiscard]] virtual Outcome<HookView> track(const RectifiedFrame& frame,
                                                const std::optional<Pose>& c1Mo_predicted) = 0;
};

}  // namespace ringhook
