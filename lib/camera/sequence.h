#pragma once

/// \file
/// A stored sequence: a folder of images with their times, the rig that took them and the target
/// that they show (doc/formats.md, "sequence folder"). Two layouts are read: the project's own
/// (sequence.yaml) and EuRoC/ASL (cam0/data.csv; Burri et al., "The EuRoC micro aerial vehicle
/// datasets", IJRR 2016). Opening checks everything but the pixels: each file exists, each number
/// parses, time grows. All refusals are InputErrors that name file, line and column.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/joints.h"
#include "core/pose.h"
#include "core/time.h"
#include "rig/stereo_rig.h"

namespace ringhook {

/// One stored pair of images.
struct SequenceFrame {
  std::uint64_t frame = 0;      ///< number as stored
  Time time;                    ///< mid-exposure
  std::filesystem::path left;   ///< absolute, or relative to the working folder
  std::filesystem::path right;  ///< the same; empty for a sequence of one camera
  int left_x_px = 0;            ///< column of the left image's window in the full image [px]
  int left_y_px = 0;            ///< row of it [px]
  int right_x_px = 0;           ///< column of the right image's window in the full image [px]
  int right_y_px = 0;           ///< row of it [px]
  bool placed = false;          ///< the table tells these, so images may be parts of the full one
};

/// A pose with its time; which pose it is, the field that holds it says.
struct StampedPose {
  Time time;
  Pose pose;  ///< translation [m]
};

/// The arm at one instant.
struct StampedArm {
  Time time;
  JointVector position;  ///< joint angles [rad]
  Pose fMe;              ///< flange in the robot reference
};

struct Sequence {
  std::string name;
  double rate_hz = 0.0;                 ///< nominal frame rate [Hz]
  std::filesystem::path rig_file;       ///< empty for an ASL folder, whose `rig` is set
  std::optional<StereoRig> rig;         ///< from an ASL folder's sensor.yaml
  std::filesystem::path target_file;    ///< marker.yaml or .cao; empty if not told
  std::filesystem::path settings_file;  ///< ViSP tracker settings (.xml); empty if not told
  std::optional<Pose> c1Mo_start;       ///< target in the left camera at the first frame
  std::string notes;
  std::string licence;
  std::vector<SequenceFrame> frames;    ///< at least one, time strictly growing
  std::vector<StampedPose> c1Mo_truth;  ///< of the target, time strictly growing; may be empty
  std::vector<StampedArm> robot;        ///< time strictly growing; may be empty
};

/// Opens a folder of either layout. Relative names inside are relative to the folder, image names
/// to its optional key `images`. Throws InputError.
[[nodiscard]] Sequence openSequence(const std::filesystem::path& folder);

/// A time and pose table with the columns time_s,x,y,z,qx,qy,qz,qw (truth.csv). Throws InputError,
/// also for time that does not grow and for a quaternion whose norm is not 1 within 1 %.
[[nodiscard]] std::vector<StampedPose> readStampedPoses(const std::filesystem::path& file);

/// Pose from "x,y,z,qx,qy,qz,qw" [m], or from a ViSP .pos file of that name (x, y, z, and the
/// rotation vector theta*u [rad]). Throws InputError that begins with `where`.
[[nodiscard]] Pose poseFromText(const std::string& text, const std::string& where);

}  // namespace ringhook
