#include "sim/sensor_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ringhook {
namespace {

constexpr std::uint64_t kTableSize = 1U << 16U;

/// Bits of one number spread over all (splitmix64, Steele, Lea, Flood, OOPSLA 2014).
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

double uniform(std::uint64_t bits) { return (static_cast<double>(bits >> 11U) + 0.5) * 0x1p-53; }

/// Standard normal values by the method of Box and Muller (1958).
std::vector<float> normalTable() {
  std::vector<float> table(kTableSize);
  for (std::uint64_t i = 0; i < kTableSize; i += 2) {
    const double radius = std::sqrt(-2.0 * std::log(uniform(mix(i))));
    const double angle = 2.0 * std::numbers::pi * uniform(mix(i + 1));
    table[i] = static_cast<float>(radius * std::cos(angle));
    table[i + 1] = static_cast<float>(radius * std::sin(angle));
  }
  return table;
}

}  // namespace

SensorNoise::SensorNoise(const SensorOptions& options)
    : options_(options), normals_(normalTable()) {
  for (std::size_t grey = 0; grey < sigma_.size(); ++grey) {
    sigma_[grey] = static_cast<float>(sigma(static_cast<double>(grey)));
  }
}

double SensorNoise::sigma(double grey) const {
  if (!options_.noise) {
    return 0.0;
  }
  const double electrons = grey / 255.0 * options_.full_well_e;
  const double variance = electrons + options_.read_noise_e * options_.read_noise_e;
  return 255.0 / options_.full_well_e * std::sqrt(variance);
}

void SensorNoise::expose(const ExposureKey& key, int x0, int y, const float* brightness, int count,
                         std::uint8_t* grey) const {
  const std::uint64_t place =
      2U * static_cast<std::uint64_t>(y) + static_cast<std::uint64_t>(key.side);
  const std::uint64_t start =
      mix(mix(mix(key.seed) ^ key.frame) ^ place) + static_cast<std::uint64_t>(x0);
  const auto gain = static_cast<float>(options_.gain);
  for (int i = 0; i < count; ++i) {
    const float light = std::min(255.0F, gain * brightness[i]);
    const float normal = normals_[(start + static_cast<std::uint64_t>(i)) % kTableSize];
    const float value = light + sigma_[static_cast<std::size_t>(light)] * normal;
    grey[i] = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
  }
}

}  // namespace ringhook
