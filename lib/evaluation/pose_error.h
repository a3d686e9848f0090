#pragma once

/// \file
/// How far an estimated pose lies from the truth: length of the difference of the positions, and
/// angle of the rotation between the two (geodesic distance on SO(3); Huynh, "Metrics for 3D
/// rotations", JMIV 2009), with the statistics that the tables show.

#include <cstddef>
#include <optional>
#include <vector>

#include "camera/sequence.h"
#include "core/pose.h"

namespace ringhook {

/// Distance between two positions of b in a [m].
[[nodiscard]] double positionError(const Pose& aMb_estimate, const Pose& aMb_truth);

/// Angle between two orientations of b in a [rad], 0 to pi.
[[nodiscard]] double rotationError(const Pose& aMb_estimate, const Pose& aMb_truth);

/// Of errors that are all >= 0, in their own unit.
struct ErrorStatistics {
  std::size_t count = 0;
  double mean = 0.0;
  double std = 0.0;  ///< about the mean, divided by count - 1; 0 for one value
  double rms = 0.0;
  double max = 0.0;
};

/// All zero for no values.
[[nodiscard]] ErrorStatistics errorStatistics(const std::vector<double>& errors);

/// Smallest value that at least `percent` of the values do not exceed (nearest rank).
/// Preconditions: values not empty, 0 < percent <= 100.
[[nodiscard]] double percentile(std::vector<double> values, double percent);

/// True pose at `time`, interpolated between neighbours; nothing before the first or after the
/// last by more than 0.1 ms. `poses` in growing time.
[[nodiscard]] std::optional<Pose> poseAt(const std::vector<StampedPose>& poses, Time time);

}  // namespace ringhook
