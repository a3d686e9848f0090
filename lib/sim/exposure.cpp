#include "sim/exposure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ringhook {
namespace {

constexpr double kStandstill = 0.01;  // [px]
constexpr double kOnePoint = 0.05;    // motion below which mid-exposure will do [px]
constexpr double kFarOff = 1e5;       // farther off no coordinate is told apart [px]
constexpr int kMostInstants = 24;
constexpr int kMargin = 4;  // pixels around what moves, for lens blur and rounding

/// P_n and its derivative at x, by the three-term recurrence.
std::pair<double, double> legendre(int n, double x) {
  double before = 1.0;
  double now = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
    before = now;
    now = next;
  }
  return {now, n * (x * now - before) / (x * x - 1.0)};
}

PlaneBox limitOf(const Window& plane) {
  return {static_cast<double>(plane.x), static_cast<double>(plane.y),
          static_cast<double>(plane.x + plane.width - 1),
          static_cast<double>(plane.y + plane.height - 1)};
}

Window around(const PlaneBox& box) {
  const int left = static_cast<int>(std::floor(box.left)) - kMargin;
  const int top = static_cast<int>(std::floor(box.top)) - kMargin;
  return {left, top, static_cast<int>(std::ceil(box.right)) + kMargin - left + 1,
          static_cast<int>(std::ceil(box.bottom)) + kMargin - top + 1};
}

/// Where a solid passes during the exposure, inside the plane.
Window passage(const Solid& from, const Solid& to, const Pinhole& eye, const Window& plane) {
  const PlaneBox limit = limitOf(plane);
  const PlaneBox a = footprint(from, eye, limit);
  const PlaneBox b = footprint(to, eye, limit);
  const PlaneBox both{std::clamp(std::min(a.left, b.left), -kFarOff, kFarOff),
                      std::clamp(std::min(a.top, b.top), -kFarOff, kFarOff),
                      std::clamp(std::max(a.right, b.right), -kFarOff, kFarOff),
                      std::clamp(std::max(a.bottom, b.bottom), -kFarOff, kFarOff)};
  return intersect(around(both), plane);
}

/// Adds a rectangle, united with all that it meets, until it meets none.
void add(std::vector<Window>& parts, Window part) {
  for (auto other = parts.begin(); other != parts.end();) {
    if (intersect(*other, part).empty()) {
      ++other;
      continue;
    }
    part = unite(*other, part);
    parts.erase(other);
    other = parts.begin();
  }
  parts.push_back(part);
}

}  // namespace

std::vector<SubInstant> subInstants(int count, double exposure_s) {
  std::vector<SubInstant> instants(static_cast<std::size_t>(count));
  if (count == 1) {
    return instants;
  }
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    for (int iteration = 0; iteration < 8; ++iteration) {
      const auto [value, slope] = legendre(count, x);
      x -= value / slope;
    }
    const double slope = legendre(count, x).second;
    instants[static_cast<std::size_t>(i)] = {0.5 * exposure_s * x,
                                             1.0 / ((1.0 - x * x) * slope * slope)};
  }
  return instants;
}

int subInstantCount(double motion_px) {
  if (motion_px < kOnePoint) {
    return 1;
  }
  return std::min(kMostInstants, 1 + static_cast<int>(std::ceil(motion_px)));
}

double largestMotion(const ExposureEnds& ends, const Pinhole& eye, const Window& plane) {
  double largest = 0.0;
  for (std::size_t i = 0; i < ends.start.size(); ++i) {
    const double motion = imageMotion(ends.start[i], ends.end[i], eye);
    if (motion > largest && !passage(ends.start[i], ends.end[i], eye, plane).empty()) {
      largest = motion;
    }
  }
  return largest;
}

std::vector<Window> movingParts(const ExposureEnds& ends, const Pinhole& eye, const Window& plane) {
  std::vector<Window> parts;
  for (std::size_t i = 0; i < ends.start.size(); ++i) {
    if (imageMotion(ends.start[i], ends.end[i], eye) > kStandstill) {
      const Window part = passage(ends.start[i], ends.end[i], eye, plane);
      if (!part.empty()) {
        add(parts, part);
      }
    }
  }
  return parts;
}

}  // namespace ringhook
