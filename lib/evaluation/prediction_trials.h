#pragma once

/// \file
/// Seeded hooks of the simulated physics for the prediction experiment, and what is seen of them.

#include <Eigen/Core>
#include <random>
#include <vector>

#include "core/hook_values.h"
#include "prediction/hook_filter.h"
#include "sim/hook_world.h"

namespace ringhook {

inline constexpr double kTrialFrame = 0.02;          ///< between frames [s]
inline constexpr double kTrialPositionSigma = 2e-4;  ///< of what is seen, per axis [m]
inline constexpr double kTrialRotationSigma = 1e-3;  ///< of a seen pose, per axis [rad]

struct TrialOptions {
  double swing_deg = 5.0;       ///< amplitude in each plane; phases are drawn
  double belt_speed = 0.2;      ///< [m/s]
  double stop_at_s = 0.0;       ///< the belt stops there; 0: it does not
  double duration_s = 3.4;      ///< of the truth
  double length_spread = 0.02;  ///< of the pivot's height above o, relative
};

/// One hook and the noise with which it is seen.
struct Trial {
  std::vector<HookWorldSample> truth;  ///< 1 ms apart
  std::mt19937 random;

  /// o at `time_s` [m].
  [[nodiscard]] Eigen::Vector3d point(double time_s) const;
  /// The hook at `time_s`, a whole millisecond.
  [[nodiscard]] const Pose& pose(double time_s) const;
  /// o as seen, with noise [m]; each call draws anew.
  Eigen::Vector3d seenPoint(double time_s);
  /// The pose as seen from a camera that stands at f.
  HookFix seenPose(double time_s);
};

/// Frames from time zero to `time_s` [s].
int trialFrame(double time_s);

/// The product's filter for these hooks: CAD as in the default cell, no noise but the fixes' own.
HookFilterOptions trialHookOptions();

/// Lets the filter see the poses of both instants and all frames between [s].
void followTrial(HookFilter& filter, Trial& trial, double from_s, double until_s);

/// `seed` draws length, friction and phases, and the noise.
Trial makeTrial(const TrialOptions& options, unsigned seed);

}  // namespace ringhook
