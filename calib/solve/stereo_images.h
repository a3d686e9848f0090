#pragma once

/// \file
/// From two lists of image files to the views that a stereo calibration is made of. Files are
/// paired by their order of names; a pair counts only if the board is found in both.

#include <filesystem>
#include <string>
#include <vector>

#include "calib/solve/stereo_problem.h"
#include "core/image.h"

namespace ringhook {

struct StereoViews {
  std::vector<StereoView> usable;
  std::vector<RejectedView> rejected;
};

/// Files that match the shell pattern, in natural order. Throws InputError, starting with `option`,
/// if there is none.
std::vector<std::filesystem::path> expandGlob(const std::string& pattern,
                                              const std::string& option);

/// Looks for the board in every pair. Throws InputError for lists of different length, unreadable
/// files, and boards found in images of different sizes; pairs without the board are `rejected`.
StereoViews findViews(const std::vector<std::filesystem::path>& left,
                      const std::vector<std::filesystem::path>& right, const Board& board,
                      const StepHook& hook);

}  // namespace ringhook
