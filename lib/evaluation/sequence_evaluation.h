#pragma once

/// \file
/// Runs one or more methods over the frames of a camera, side by side on the same rectified images:
/// camera -> rectifier -> tracker -> fix. The prediction that a tracker starts from moves on with
/// the constant velocity of the last two fixes (the twist between them), as long as the hook is
/// tracked; after a loss the last pose is held. A tracker that cannot search the whole image is
/// tried again from the last pose when it refuses, once a frame.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "camera/sequence.h"
#include "camera/stereo_camera.h"
#include "core/hook_values.h"
#include "evaluation/evaluation_method.h"
#include "rig/rectifier.h"

namespace ringhook {

/// What one method made of one frame.
struct FrameRecord {
  std::uint64_t frame = 0;               ///< number as stored
  Time time;                             ///< mid-exposure
  std::optional<HookFix> fix;            ///< nothing if not tracked
  std::string reason;                    ///< why not tracked; empty if tracked
  std::optional<double> position_error;  ///< to the truth [m]
  std::optional<double> rotation_error;  ///< to the truth [rad]
  Window left_window;                    ///< of the raw left image [px]
  Window right_window;                   ///< of the raw right image [px]; empty for one camera
  double read_s = 0.0;                   ///< taking and decoding the images [s]
  double rectify_s = 0.0;                ///< [s]
  double track_s = 0.0;                  ///< [s]
  double fix_s = 0.0;                    ///< [s]
};

/// One tracked frame with its picture, for looking at.
struct Snapshot {
  RectifiedView left;
  HookView view;
  HookFix fix;
};

struct MethodRun {
  std::string name;
  std::vector<FrameRecord> frames;
  std::optional<Snapshot> first;  ///< first tracked frame; of the first method only
  std::optional<Snapshot> last;   ///< last tracked frame; of the first method only
};

struct SequenceRunOptions {
  std::optional<Pose> c1Mo_start;                 ///< target in the left camera at the first frame
  std::vector<StampedPose> c1Mo_truth;            ///< in growing time; may be empty
  std::function<double()> clock_s;                ///< steady clock, for the stage times [s]
  std::function<bool(std::size_t done)> proceed;  ///< called after each frame; false ends the run
};

/// Runs until the camera is finished or `proceed` says no. Throws InputError for a method that
/// needs a start where there is none, and what camera and trackers throw.
[[nodiscard]] std::vector<MethodRun> runSequence(StereoCamera& camera, const Rectifier& rectifier,
                                                 std::vector<EvaluationMethod>& methods,
                                                 const SequenceRunOptions& options);

/// Constant-velocity prediction at `time` from fixes at a.time < b.time: the twist that led from a
/// to b goes on.
[[nodiscard]] Pose predictConstantVelocity(const StampedPose& a, const StampedPose& b, Time time);

}  // namespace ringhook
