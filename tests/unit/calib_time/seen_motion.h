#pragma once

/// \file
/// A motion that an arm made and two cameras watched, from formulas alone: the flange moves by sums
/// of sines, corners are projected by a pinhole written out here, and both clocks are wrong by what
/// the test says.

#include <random>

#include "calib/solve/time_delay.h"

namespace ringhook::test {

struct SeenMotionSettings {
  double arm_delay_s = 0.0;     ///< states' stamps behind their sampling
  double camera_delay_s = 0.0;  ///< frames' stamps behind mid-exposure
  double amplitude_m = 0.010;   ///< of the flange's motion
  double noise_px = 0.06;       ///< of a corner, per axis
  double joint_noise_m = 0.0;   ///< of the flange by the states
  double told_wrong_m = 0.0;    ///< error of the told fMc1, every axis
  double told_wrong_rad = 0.0;  ///< likewise
  double wild_share = 0.0;      ///< of corners that are off by 20 px
  double seconds = 6.0;
  std::uint64_t seed = 1;
};

PlateMotion seenMotion(const SeenMotionSettings& settings);

/// The law of the motion: fMe at an instant [s].
Pose flangeAt(double t, double amplitude_m);

}  // namespace ringhook::test
