#pragma once

/// \file
/// Seeded random joint vectors for the tests of the arm.

#include <random>

#include "core/joints.h"

namespace ringhook {

class JointSamples {
 public:
  explicit JointSamples(unsigned seed) : engine_(seed) {}

  /// Uniform within the position limits [rad].
  JointVector within(const JointLimits& limits) {
    JointVector q;
    for (int i = 0; i < 6; ++i) {
      q(i) = std::uniform_real_distribution<double>(limits.lower(i), limits.upper(i))(engine_);
    }
    return q;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace ringhook
