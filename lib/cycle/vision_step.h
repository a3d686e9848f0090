#pragma once

/// \file
/// One turn of the vision clock: a stereo frame in, the hook's estimate and the next windows out.
///   frame -> rectified window -> hook seen -> pose fix -> filter -> next window
/// A hook is looked for where the belt brings it in (search window, low rate); once fixed it is
/// followed in windows from the predicted covariance (tracking rate). "Searching" is a named state
/// with a reason, and ends by itself when a hook is found. Reads no clock.

#include <array>
#include <deque>
#include <optional>
#include <string>

#include "core/hook_values.h"
#include "core/stereo_frame.h"
#include "cycle/cell_config.h"
#include "cycle/hook_sight.h"
#include "prediction/hook_filter.h"
#include "rig/rectifier.h"

namespace ringhook {

enum class VisionState {
  kSearching,  ///< no hook; the belt's entrance is watched
  kWarmingUp,  ///< a hook is tracked, its estimate not yet fit to act upon
  kTracking    ///< the estimate may be acted upon
};

/// What one frame brought.
struct VisionReport {
  Time time;  ///< mid-exposure
  VisionState state = VisionState::kSearching;
  std::string reason;                   ///< why this frame gave no fix; empty if it did
  std::optional<HookFix> fix;           ///< taken by the filter
  double nis = 0.0;                     ///< of the fix; chi-square of 6 if consistent
  std::optional<double> error_100ms_m;  ///< fix against the prediction made 100 ms before, at o
};

/// How long after a frame the next one is to be expected [s], when the last two were `last_s`
/// apart: a camera that cannot keep up with `rate_hz` is known by its last interval; without one it
/// is taken at its word. Longer than 0.2 s is not looked ahead: windows would only grow.
double expectedInterval(const std::optional<double>& last_s, double rate_hz);

class VisionStep {
 public:
  /// Loads the models that the cell names. Throws InputError for bad files.
  VisionStep(const CellConfig& cell, const StereoRig& rig, TrackerKind tracker);

  VisionReport process(const StereoFrame& frame);

  /// Forgets the hook and looks for the next one.
  void restart();

  [[nodiscard]] VisionState state() const { return state_; }
  /// Snapshot for the control side; nothing while searching.
  [[nodiscard]] std::optional<HookFilterState> estimate() const;
  /// Regions that the cameras shall read next, left and right, in the full (distorted) image.
  [[nodiscard]] const std::array<Window, 2>& windows() const { return windows_; }
  /// Frames per second that this state needs [Hz].
  [[nodiscard]] double rateHz() const;

 private:
  Outcome<HookFix> see(const StereoFrame& frame);
  [[nodiscard]] std::optional<Pose> predicted(Time time) const;
  void take(const HookFix& fix, VisionReport& report);
  void miss(const std::string& reason, VisionReport& report);
  void compareWithPast(const HookFix& fix, VisionReport& report);
  void planWindows(Time now);
  [[nodiscard]] std::optional<Window> windowAt(Time exposure, int side) const;

  CellConfig cell_;
  Pose fMc1_;
  Rectifier rectifier_;
  HookSight sight_;
  HookFilter filter_;
  VisionState state_ = VisionState::kSearching;
  int misses_ = 0;
  std::optional<Time> last_frame_;
  double frame_interval_s_ = 0.0;  ///< expected until the next frame
  std::array<Window, 2> search_windows_;
  std::array<Window, 2> windows_;
  std::deque<HookFilterState> past_;  ///< snapshots of the last 100 ms and a little more
};

}  // namespace ringhook
