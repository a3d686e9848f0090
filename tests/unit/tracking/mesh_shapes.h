#pragma once

/// \file
/// Solids as Wavefront text, for tests: prisms over an outline, in as many spellings as needed.

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace ringhook::test {

using Outline = std::vector<Eigen::Vector2d>;

inline Outline square(double side) { return {{0, 0}, {side, 0}, {side, side}, {0, side}}; }

/// Beginning at its inward corner.
inline Outline ell(double s) {
  return {{s, s}, {s, 2 * s}, {0, 2 * s}, {0, 0}, {2 * s, 0}, {2 * s, s}};
}

inline Outline circle(double radius, int corners) {
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

inline std::string pointLine(double x, double y, double z) {
  std::ostringstream text;
  text.precision(12);
  text << "v " << x << ' ' << y << ' ' << z << '\n';
  return text.str();
}

/// A prism of z = 0 to `height` over an outline; its sides as two triangles each if `triangles`,
/// its ends as fans from `hub`, which must see all corners, or as one polygon if `hub` is negative.
inline std::string prism(const Outline& outline, double height, bool triangles, int hub = -1,
                         int first = 1) {
  std::ostringstream text;
  const int n = static_cast<int>(outline.size());
  for (const double z : {0.0, height}) {
    for (const Eigen::Vector2d& p : outline) {
      text << pointLine(p.x(), p.y(), z);
    }
  }
  const auto low = [&](int i) { return first + i % n; };
  const auto high = [&](int i) { return first + n + i % n; };
  for (int i = 0; i < n; ++i) {
    const int j = i + 1;
    if (triangles) {
      text << "f " << low(i) << ' ' << low(j) << ' ' << high(j) << "\nf " << low(i) << ' '
           << high(j) << ' ' << high(i) << '\n';
    } else {
      text << "f " << low(i) << ' ' << low(j) << ' ' << high(j) << ' ' << high(i) << '\n';
    }
  }
  if (hub < 0) {
    text << "f";
    for (int i = 0; i < n; ++i) {
      text << ' ' << high(i);
    }
    text << "\nf";
    for (int i = n - 1; i >= 0; --i) {
      text << ' ' << low(i);
    }
    text << '\n';
    return text.str();
  }
  for (int i = hub + 1; i < hub + n - 1; ++i) {
    text << "f " << high(hub) << ' ' << high(i) << ' ' << high(i + 1) << "\nf " << low(hub) << ' '
         << low(i + 1) << ' ' << low(i) << '\n';
  }
  return text.str();
}

}  // namespace ringhook::test
