#pragma once

/// \file
/// The compared ways from rectified images to a pose. Each joins a tracker with a way to turn what
/// it saw into a fix:
///   edges            ViSP's edge tracker, then the joint refinement over its sites
///   edges-visp       the pose as ViSP's own robust minimisation gives it
///   marker-joint     tag corners, least reprojection error over all corners of both views
///   marker-midpoint  each corner triangulated at the midpoint, then a plane fitted (the way of the
///                    2007 report (Jeyabalan, Fork project))
///   marker-single    the left view alone

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tracking/hook_tracker.h"

namespace ringhook {

struct EvaluationMethod {
  std::string name;
  std::unique_ptr<HookTracker> tracker;
  /// A covariance or rms_px that the method cannot tell is NaN.
  std::function<Outcome<HookFix>(const HookView&)> fix;
  bool left_only = false;    ///< sees the left view only
  bool needs_start = false;  ///< cannot search a whole image
};

/// All names, in the order above.
[[nodiscard]] const std::vector<std::string>& methodNames();

/// The method for a target file: edges for .cao, marker-joint for .yaml. Throws InputError for any
/// other file.
[[nodiscard]] std::string defaultMethod(const std::filesystem::path& target);

/// \param target marker.yaml or .cao. \param settings ViSP's tracker XML for the edge methods;
/// empty for the defaults. \param stereo two cameras? Throws InputError for an unknown name (which
/// lists the names), a method that does not fit the target or the cameras, and broken files.
[[nodiscard]] EvaluationMethod makeMethod(const std::string& name,
                                          const std::filesystem::path& target,
                                          const std::filesystem::path& settings, bool stereo);

}  // namespace ringhook
