#include "camera/readout_region.h"

#include <algorithm>
#include <array>

namespace ringhook {
namespace {

constexpr std::array<int, 7> kLadder = {128, 256, 384, 512, 768, 1024, 1536};  // [px]
constexpr int kRungsTooLarge = 2;

struct Span {
  int begin = 0;
  int size = 0;
};

int roundedUp(int value, int step) { return (value + step - 1) / step * step; }

/// Rung that holds `size`; kLadder.size() stands for the whole sensor.
std::size_t rungOf(int size) {
  const auto* const rung = std::lower_bound(kLadder.begin(), kLadder.end(), size);
  return static_cast<std::size_t>(rung - kLadder.begin());
}

int sizeOfRung(std::size_t rung, int sensor, const RegionSteps& steps) {
  const int largest = sensor / steps.size * steps.size;
  if (rung >= kLadder.size()) {
    return largest;
  }
  return std::min(std::max(roundedUp(kLadder.at(rung), steps.size), steps.smallest), largest);
}

/// Size along one axis for a window [asked.begin, asked.begin + asked.size).
int sizeFor(int asked, int current, int sensor, const RegionSteps& steps) {
  // An offset that must be rounded down needs this much more.
  const int needed = asked + steps.offset - 1;
  const std::size_t rung = rungOf(needed);
  const bool keeps = current >= std::min(needed, sensor) &&
                     current <= sizeOfRung(rung + kRungsTooLarge, sensor, steps);
  return keeps ? current : sizeOfRung(rung, sensor, steps);
}

Span axis(const Span& asked, int current, int sensor, const RegionSteps& steps) {
  Span region;
  region.size = sizeFor(asked.size, current, sensor, steps);
  const int centred = asked.begin - (region.size - asked.size) / 2;
  const int last = (sensor - region.size) / steps.offset * steps.offset;
  region.begin = std::clamp(centred / steps.offset * steps.offset, 0, std::max(0, last));
  // At the far border a rounded offset may leave the window's end outside: then read to the end.
  if (region.begin + region.size < asked.begin + asked.size) {
    region = {0, sizeOfRung(kLadder.size(), sensor, steps)};
  }
  return region;
}

}  // namespace

Window readoutRegion(const Window& asked, const Window& current, const RegionLimits& limits) {
  const Window sensor{0, 0, limits.sensor_width, limits.sensor_height};
  Window wanted = intersect(asked, sensor);
  if (wanted.empty()) {
    wanted = sensor;
  }
  const Span x = axis({wanted.x, wanted.width}, current.width, limits.sensor_width, limits.x);
  const Span y = axis({wanted.y, wanted.height}, current.height, limits.sensor_height, limits.y);
  return {x.begin, y.begin, x.size, y.size};
}

}  // namespace ringhook
