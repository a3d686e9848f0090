#pragma once

/// \file
/// Models and settings of the edge tracker: the moving-edge search along model lines (Bouthemy, "A
/// maximum likelihood framework for determining moving edges", PAMI 1989), visibility, and when a
/// pose is no longer believed. Names follow ViSP's tracker file, which can be read as it is.

#include <filesystem>

#include "core/pose.h"

namespace ringhook {

/// A model file and its place in the hook frame.
struct EdgeModelFile {
  std::filesystem::path path;       ///< .cao
  Pose oMmodel = Pose::Identity();  ///< the file's frame in o
};

struct EdgeTrackerOptions {
  int mask_size = 5;          ///< side of the oriented gradient mask [px]
  int mask_number = 180;      ///< orientations of the mask
  int range_px = 8;           ///< search to each side of the predicted line [px]
  double threshold = 5000.0;  ///< least likelihood of an edge (ViSP's unnormalised measure)
  double mu1 = 0.5;           ///< contrast may fall to (1 - mu1) of the last frame's
  double mu2 = 0.5;           ///< contrast may rise to (1 + mu2) of the last frame's
  double sample_step_px = 4;  ///< distance between sites along a line [px]

  double angle_appear = 1.396;     ///< a face is used below this angle to the line of sight [rad]
  double angle_disappear = 1.483;  ///< a face is dropped above this angle [rad]
  double near_m = 0.05;            ///< nearest depth that is tracked [m]
  double far_m = 10.0;             ///< farthest depth that is tracked [m]
  bool clip_to_image = true;       ///< drop the parts of lines outside the image

  double reset_px = 1.0;        ///< prediction further than this from the last pose restarts [px]
  int min_sites = 20;           ///< fewer edge sites are no hook
  double min_good_ratio = 0.4;  ///< least part of the sites that agree with the pose
  double max_spread_px = 3.0;   ///< largest robust deviation of the sites from the lines [px]
  double max_direction_deg = 25.0;  ///< largest mean angle between gradient and line normal [deg]
};

/// Moving-edge, face and clipping settings from ViSP's tracker XML; the rest keeps its defaults.
/// Throws InputError naming the file.
EdgeTrackerOptions loadEdgeSettings(const std::filesystem::path& path);

/// Throws InputError naming the option that is out of range.
void checkEdgeSettings(const EdgeTrackerOptions& options);

}  // namespace ringhook
