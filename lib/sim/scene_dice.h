#pragma once

/// \file
/// Seeded draws for the scene's looks, made from the generator's bits, so that a seed means the
/// same scene with every standard library. Each use has a stream of its own: more clutter does not
/// move the lamps.

#include <cstdint>
#include <random>

#include "sim/scene_options.h"

namespace ringhook {

enum class SceneStream : std::uint64_t { lamps = 1, wall, wall_tone, clutter, occluders };

class SceneDice {
 public:
  /// \param cell_seed used where options.seed is 0.
  SceneDice(const SceneOptions& options, std::uint64_t cell_seed, SceneStream stream)
      : bits_((options.seed == 0 ? cell_seed : options.seed) * 0x9e3779b97f4a7c15ULL +
              static_cast<std::uint64_t>(stream)) {}

  /// Uniform in [low, high).
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11U) * 0x1p-53;
  }
  /// 1 + uniform(-spread, +spread).
  double factor(double spread) { return 1.0 + between(-spread, spread); }
  /// One of 0 .. count - 1.
  int below(int count) { return static_cast<int>(bits_() % static_cast<std::uint64_t>(count)); }

 private:
  std::mt19937_64 bits_;
};

}  // namespace ringhook
