#pragma once

/// \file
/// How far an estimated trajectory lies from a reference: the absolute trajectory error of the
/// benchmarks (Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012),
/// the distance between positions of the same instant, after the estimate as a whole was laid on
/// the reference by the rotation and translation, with or without a scale, that make the sum of
/// squares least (Umeyama, "Least-squares estimation of transformation parameters between two point
/// patterns", PAMI 13(4), 1991). Two formats are read, told apart by the numbers in a line: TUM
/// (8, with time) and KITTI (12, the upper rows of a pose, one line a frame and no time; Geiger et
/// al., "Are we ready for autonomous driving?", CVPR 2012).

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/time.h"

namespace ringhook {

struct PositionTrack {
  bool timed = false;                      ///< TUM; without times, a line is a frame
  std::vector<Time> times;                 ///< strictly growing; empty if not timed
  std::vector<Eigen::Vector3d> positions;  ///< in the file's own frame [m]
};

/// Throws InputError naming file and line: neither 8 nor 12 numbers, no rotation, time that does
/// not grow, a position beyond 1e9 m, no pose at all.
[[nodiscard]] PositionTrack readPositionTrack(const std::filesystem::path& file);

/// A position of each of the two, of one instant, a column each [m].
struct PositionPairs {
  Eigen::Matrix3Xd reference;
  Eigen::Matrix3Xd estimate;
};

/// Timed tracks: each estimate with the reference nearest in time, if that is within `tolerance_s`
/// and nearest to no other. Others: line by line. Throws InputError if one is timed and the other
/// is not, if tracks without times differ in length, or if there are fewer than three pairs.
[[nodiscard]] PositionPairs pairTracks(const PositionTrack& reference,
                                       const PositionTrack& estimate, double tolerance_s);

enum class Alignment { kNone, kSe3, kSim3 };

/// "none", "se3" or "sim3"; throws InputError for another.
[[nodiscard]] Alignment alignmentFromText(const std::string& text);

/// Of the distances between the pairs, estimate aligned.
struct TrackError {
  std::size_t pairs = 0;
  double scale = 1.0;  ///< of the alignment
  double rmse_m = 0.0;
  double mean_m = 0.0;
  double median_m = 0.0;
  double std_m = 0.0;  ///< about the mean, divided by the number of pairs, as evo has it
  double min_m = 0.0;
  double max_m = 0.0;
};

/// Throws InputError if positions that all stand in one place or line leave the alignment open.
[[nodiscard]] TrackError trackError(const PositionPairs& pairs, Alignment alignment);

/// summary.json of `ringhook evaluate compare`.
[[nodiscard]] std::string trackErrorJson(const TrackError& error, Alignment alignment);

}  // namespace ringhook
