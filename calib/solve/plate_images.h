#pragma once

/// \file
/// From image files of a tag plate and files of flange poses to the views that plate_views.h takes.
/// Images are paired with each other and with poses by their order of names.

#include <filesystem>
#include <vector>

#include "calib/solve/plate_views.h"
#include "rig/stereo_rig.h"
#include "tracking/tag_plate.h"

namespace ringhook {

struct PlateImages {
  std::vector<std::filesystem::path> left;
  std::vector<std::filesystem::path> right;  ///< empty: the left camera alone
  std::vector<std::filesystem::path> poses;  ///< ViSP's pose file per image, or one table (.csv)
};

struct FoundPlates {
  std::vector<PlateView> views;
  std::vector<RejectedPair> blind;  ///< images without the plate; index among the images
};

/// Flange poses of all images. Throws InputError for numbers that do not match and bad files.
std::vector<Pose> readFlangePoses(const PlateImages& images);

/// Looks for the plate in all images, at their full size, and undistorts its corners exactly. oMk
/// of the plate is not looked at. Throws InputError for unreadable files, images whose size is not
/// the rig's, and right images for a rig of one camera.
FoundPlates findPlates(const PlateImages& images, const StereoRig& rig, TagPlate plate,
                       const StepHook& hook);

}  // namespace ringhook
