#pragma once

/// \file
/// Seeded random lives of a limiter: random settings and start, a plant that does exactly what it
/// is sent, and wanted velocities of every kind, garbage included. The test and the campaign of
/// millions of inputs share it.

#include <random>

#include "limit_watch.h"

namespace ringhook {

class LimiterTrial {
 public:
  explicit LimiterTrial(unsigned long seed);

  /// One input after the other; returns what broke and how near the limits came.
  WatchResult run(long inputs);

 private:
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }
  JointVector vector();
  double garbage();
  LimiterSettings randomSettings();
  JointVector randomStart();
  void surround();
  JointVector wanted(long k);
  JointVector measured();

  std::mt19937_64 engine_;
  LimiterSettings settings_;
  JointVector q_;               ///< where the arm really is [rad]
  JointVector held_;            ///< wanted for a while [rad/s]
  int kind_ = 0;                ///< of the wanted velocities
  bool told_nonsense_ = false;  ///< by the measurement before
};

}  // namespace ringhook
