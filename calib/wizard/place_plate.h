#pragma once

/// \file
/// Sees a tag plate in the frames of a place and says which windows to read: the whole images until
/// it is found, then one window a camera that holds all of a motion known beforehand. A window that
/// followed the plate would have to act in time, and on a network it acts frames later.

#include <array>
#include <vector>

#include "core/hook_values.h"
#include "core/outcome.h"
#include "core/stereo_frame.h"
#include "rig/rectifier.h"
#include "rig/stereo_rig.h"
#include "tracking/marker_tracker.h"

namespace ringhook {

class PlateWatch {
 public:
  /// \param plate its own frame k stands for o of what is seen.
  PlateWatch(const StereoRig& rig, const TagPlate& plate);

  /// The plate in both images of the frame. Refuses "no tag seen" and "not in both images".
  Outcome<HookView> see(const StereoFrame& frame);

  /// To be read next, left and right, in the full image [px].
  [[nodiscard]] const std::array<Window, 2>& windows() const { return windows_; }
  /// From now on the windows hold the plate at all these poses in the left camera.
  void watchOver(const std::vector<Pose>& c1Mo);

 private:
  TagPlate plate_;
  Rectifier rectifier_;
  MarkerTracker tracker_;
  Window full_;
  std::array<Window, 2> windows_;
};

/// The plate of a file in its own frame: an oMk that the file gives is left out.
TagPlate plateInItsOwnFrame(TagPlate plate);

}  // namespace ringhook
