#pragma once

/// \file
/// Trajectories in the TUM format, "time tx ty tz qx qy qz qw" (s, m), one pose a line (Sturm et
/// al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012), readable by evo and
/// rpg_trajectory_evaluation.

#include <filesystem>
#include <vector>

#include "camera/sequence.h"

namespace ringhook {

/// Writes the file whole or not at all; nanoseconds and nanometres survive. Throws Error.
void writeTum(const std::filesystem::path& file, const std::vector<StampedPose>& poses);

/// Skips comments (#) and empty lines. Throws InputError naming the line: not eight numbers, time
/// that does not grow, a quaternion whose norm is not 1 within 1 %, no pose at all.
[[nodiscard]] std::vector<StampedPose> readTum(const std::filesystem::path& file);

}  // namespace ringhook
