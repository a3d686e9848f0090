#include "sim/sensor_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ringhook {
namespace {

constexpr std::uint64_t kTableSize = 1U << 16U;
constexpr std::uint64_t kLongestRow = 8192;
constexpr double kFillTime = 0.0005;  // in which brightness 255 fills the well [s]

/// Bits of one number spread over all (splitmix64, Steele, Lea, Flood, OOPSLA 2014).
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

double uniform(std::uint64_t bits) { return (static_cast<double>(bits >> 11U) + 0.5) * 0x1p-53; }

/// Standard normal values by the method of Box and Muller (1958); the first ones follow once more
/// at the end, so that a row may start anywhere.
std::vector<float> normalTable() {
  std::vector<float> table(kTableSize);
  for (std::uint64_t i = 0; i < kTableSize; i += 2) {
    const double radius = std::sqrt(-2.0 * std::log(uniform(mix(i))));
    const double angle = 2.0 * std::numbers::pi * uniform(mix(i + 1));
    table[i] = static_cast<float>(radius * std::cos(angle));
    table[i + 1] = static_cast<float>(radius * std::sin(angle));
  }
  table.insert(table.end(), table.begin(), table.begin() + kLongestRow);
  return table;
}

}  // namespace

SensorNoise::SensorNoise(const SensorOptions& options)
    : options_(options), normals_(normalTable()) {}

void SensorNoise::expose(const ExposureKey& key, int x0, int y, const float* brightness, int count,
                         std::uint8_t* grey) const {
  const std::uint64_t place =
      2U * static_cast<std::uint64_t>(y) + static_cast<std::uint64_t>(key.side);
  const std::uint64_t start =
      mix(mix(mix(key.seed) ^ key.frame) ^ place) + static_cast<std::uint64_t>(x0);
  const float* normals = &normals_[start % kTableSize];
  const double well = options_.full_well_e;
  const auto electrons = static_cast<float>(well / 255.0 * options_.exposure_s / kFillTime);
  const auto full = static_cast<float>(well);
  const auto read2 = static_cast<float>(options_.read_noise_e * options_.read_noise_e);
  const float noise = options_.noise ? 1.0F : 0.0F;
  const auto amplifier = static_cast<float>(options_.gain * 255.0 / well);
  const auto black = static_cast<float>(options_.black_level + 0.5);
  for (int i = 0; i < count; ++i) {
    const float e = std::min(full, electrons * brightness[i]);
    const float collected = e + noise * std::sqrt(e + read2) * normals[i];
    const float value = std::min(255.0F, std::max(0.0F, amplifier * collected + black));
    grey[i] = static_cast<std::uint8_t>(value);
  }
}

}  // namespace ringhook
