#pragma once

/// \file
/// A calibrated rig of two cameras (or one), as calibration writes it and everything else reads
/// it: rig.yaml, OpenCV's FileStorage format, readable by cv::FileStorage in C++ and Python.
/// Keys with OpenCV's meaning: image_width image_height K1 D1 K2 D2 R T (x2 = R x1 + T, that is
/// c2Mc1), then the optional fMc1 with the arm's joint zeros, delays and evidence. A rig of one
/// camera has K1 and D1 only.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.h"
#include "rig/camera_model.h"

namespace ringhook {

/// A top-level entry of rig.yaml that this program does not know: kept and written back.
struct UnknownEntry {
  std::string key;
  std::string text;  ///< its YAML lines as they stood, from the key to the last line break
};

struct StereoRig {
  CameraModel left;
  std::optional<CameraModel> right;  ///< absent for a rig of one camera; same size as left
  Pose c2Mc1 = Pose::Identity();     ///< left camera in right camera (OpenCV's R, T)
  std::optional<Pose> fMc1;          ///< left camera in the robot reference frame
  /// Joint angles of the arm, true minus reported [rad]; fMc1 belongs to the arm so corrected.
  Eigen::Matrix<double, 6, 1> joint_zeros_rad = Eigen::Matrix<double, 6, 1>::Zero();
  double robot_delay_s = 0.0;   ///< arm state: message stamp minus sampling instant
  double camera_delay_s = 0.0;  ///< frame: arrival minus mid-exposure

  // Evidence of the calibration, each absent if the file does not tell.
  std::optional<double> rms_px;                         ///< reprojection error of the fit [px]
  std::optional<double> heldout_vertical_disparity_px;  ///< RMS, views outside the fit [px]
  std::optional<std::string> board;                     ///< as in --board: chessboard:9x6:25mm
  std::optional<int> views;                             ///< pairs used
  std::optional<std::string> date;
  std::optional<std::string> tool_version;

  std::vector<UnknownEntry> unknown_entries;
};

/// Distance between the optical centres [m]; 0 for a rig of one camera.
double baseline(const StereoRig& rig);

/// Throws InputError, one sentence that starts with `where` and names the key and what was
/// expected, unless: sizes and focal lengths are positive, K is fx 0 cx; 0 fy cy; 0 0 1, distortion
/// has 0, 4, 5 or 8 values, R and fMc1 are rigid, the baseline is not zero, joint zeros are below
/// 5 degrees, all is finite.
void checkRig(const StereoRig& rig, const std::string& where);

/// Reads rig.yaml. Throws InputError naming file and key: unreadable, not OpenCV YAML, missing or
/// ill-shaped keys, and whatever checkRig refuses. R and fMc1 become exact rotations.
StereoRig loadRig(const std::filesystem::path& path);

/// Writes rig.yaml whole or not at all, unknown entries included. Throws InputError for a rig that
/// checkRig refuses or a path that cannot be written.
void saveRig(const std::filesystem::path& path, const StereoRig& rig);

}  // namespace ringhook
