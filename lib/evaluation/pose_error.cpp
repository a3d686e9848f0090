#include "evaluation/pose_error.h"

#include <algorithm>
#include <cmath>

namespace ringhook {
namespace {

constexpr double kTolerance = 1e-4;  // a stamp written with few decimals [s]

}  // namespace

double positionError(const Pose& aMb_estimate, const Pose& aMb_truth) {
  return (aMb_estimate.translation() - aMb_truth.translation()).norm();
}

double rotationError(const Pose& aMb_estimate, const Pose& aMb_truth) {
  return thetaU(aMb_truth.linear().transpose() * aMb_estimate.linear()).norm();
}

ErrorStatistics errorStatistics(const std::vector<double>& errors) {
  ErrorStatistics statistics;
  statistics.count = errors.size();
  if (errors.empty()) {
    return statistics;
  }
  const auto count = static_cast<double>(errors.size());
  double sum = 0.0;
  double squares = 0.0;
  for (const double error : errors) {
    sum += error;
    squares += error * error;
    statistics.max = std::max(statistics.max, error);
  }
  statistics.mean = sum / count;
  statistics.rms = std::sqrt(squares / count);
  double deviations = 0.0;
  for (const double error : errors) {
    deviations += (error - statistics.mean) * (error - statistics.mean);
  }
  statistics.std = errors.size() > 1 ? std::sqrt(deviations / (count - 1.0)) : 0.0;
  return statistics;
}

double percentile(std::vector<double> values, double percent) {
  std::sort(values.begin(), values.end());
  const auto rank = std::ceil(percent / 100.0 * static_cast<double>(values.size()));
  const auto index = static_cast<std::size_t>(std::max(1.0, rank)) - 1;
  return values[std::min(index, values.size() - 1)];
}

std::optional<Pose> poseAt(const std::vector<StampedPose>& poses, Time time) {
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), time,
                       [](const StampedPose& pose, Time instant) { return pose.time < instant; });
  if (after != poses.end() && after->time - time < kTolerance) {
    return after->pose;
  }
  if (after == poses.begin()) {
    return std::nullopt;
  }
  const auto before = std::prev(after);
  if (time - before->time < kTolerance) {
    return before->pose;
  }
  if (after == poses.end()) {
    return std::nullopt;
  }
  return interpolate(before->pose, after->pose,
                     (time - before->time) / (after->time - before->time));
}

}  // namespace ringhook
