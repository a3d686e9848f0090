// plan.svg: three panels side by side, in plain SVG without scripts or fonts of its own.

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "calib/solve/plan_map.h"

namespace ringhook {
namespace {

constexpr double kPanel_px = 300.0;
constexpr double kTop_px = 60.0;

/// A square panel with its own axes; y grows upwards unless turned.
struct Panel {
  double left_px;
  double x0, x1, y0, y1;  ///< data limits; y0 stands at the bottom

  [[nodiscard]] double u(double x) const { return left_px + kPanel_px * (x - x0) / (x1 - x0); }
  [[nodiscard]] double v(double y) const {
    return kTop_px + kPanel_px * (1.0 - (y - y0) / (y1 - y0));
  }
};

/// A round step that divides a range into four to eight parts.
double roundStep(double range) {
  const double rough = range / 6.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) {
      return factor * power;
    }
  }
  return 10.0 * power;
}

std::string label(double u, double v, const std::string& text, const char* anchor = "middle") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", u, v, anchor,
                     text);
}

std::string frame(const Panel& p, const std::string& title, const std::string& x_name,
                  const std::string& y_name) {
  std::string svg = label(p.left_px + 0.5 * kPanel_px, kTop_px - 14.0, title);
  const auto round = [](double x) { return std::abs(x) < 1e-9 ? 0.0 : x; };
  const double x_step = roundStep(std::abs(p.x1 - p.x0));
  for (double x = std::ceil(std::min(p.x0, p.x1) / x_step) * x_step;
       x <= std::max(p.x0, p.x1) + 1e-9; x += x_step) {
    svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}v5\"/>", p.u(x), kTop_px + kPanel_px);
    svg += label(p.u(x), kTop_px + kPanel_px + 18.0, fmt::format("{:.4g}", round(x)));
  }
  const double y_step = roundStep(std::abs(p.y1 - p.y0));
  for (double y = std::ceil(std::min(p.y0, p.y1) / y_step) * y_step;
       y <= std::max(p.y0, p.y1) + 1e-9; y += y_step) {
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}h-5\"/>", p.left_px, p.v(y));
    svg += label(p.left_px - 8.0, p.v(y) + 4.0, fmt::format("{:.4g}", round(y)), "end");
  }
  svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\"/>\n", p.left_px,
                     kTop_px, kPanel_px, kPanel_px);
  svg += label(p.left_px + 0.5 * kPanel_px, kTop_px + kPanel_px + 36.0, x_name);
  return svg + label(p.left_px - 8.0, kTop_px - 8.0, y_name, "end");
}

/// From light to dark blue for 0 to 1.
std::string shade(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return fmt::format("rgb({:.0f},{:.0f},{:.0f})", 235 - 215 * s, 243 - 175 * s, 250 - 115 * s);
}

struct Range {
  double low;
  double high;
};

Range rangeOf(const std::vector<PlanPoint>& points) {
  Range range{points.front().total_m, points.front().total_m};
  for (const PlanPoint& p : points) {
    range = {std::min(range.low, p.total_m), std::max(range.high, p.total_m)};
  }
  return range;
}

/// Errors across the field, seen as the cameras see it: x to the right, y down.
std::string acrossPanel(const PlanMap& map) {
  const Eigen::Vector3d middle = map.middle->point_m;
  const double half = 0.6 * (map.field.high_m - map.field.low_m).maxCoeff();
  const Panel p{70.0, middle.x() - half, middle.x() + half, middle.y() + half, middle.y() - half};
  const Range range = rangeOf(map.across);
  const double side = kPanel_px * map.across_step_m / (2.0 * half) + 0.3;
  std::string svg;
  for (const PlanPoint& q : map.across) {
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
        "stroke=\"none\"/>\n",
        p.u(q.point_m.x()) - 0.5 * side, p.v(q.point_m.y()) - 0.5 * side, side, side,
        shade((q.total_m - range.low) / std::max(1e-12, range.high - range.low)));
  }
  if (map.box) {
    const Eigen::Vector3d low = map.box->centre_m - 0.5 * map.box->size_m;
    const Eigen::Vector3d high = map.box->centre_m + 0.5 * map.box->size_m;
    svg += fmt::format("<path class=\"box\" d=\"M{0:.1f} {1:.1f}H{2:.1f}V{3:.1f}H{0:.1f}Z\"/>\n",
                       p.u(low.x()), p.v(low.y()), p.u(high.x()), p.v(high.y()));
  }
  svg += frame(p,
               fmt::format("expected error at {:.3g} m: {:.3f} (light) to {:.3f} mm (dark)",
                           map.distance_m, 1e3 * range.low, 1e3 * range.high),
               "x [m]", "y [m]");
  return svg;
}

/// Errors over the distance.
std::string alongPanel(const PlanMap& map) {
  const Range range = rangeOf(map.along);
  const Panel p{460.0, map.along.front().point_m.z(), map.along.back().point_m.z(), 0.0,
                1.05e3 * range.high};
  const std::array<const char*, 4> names{"x", "y", "z", "all"};
  const std::array<const char*, 4> colours{"#2a8f4e", "#907a00", "#d1542a", "#1668b8"};
  std::string svg;
  for (int axis = 0; axis < 4; ++axis) {
    const auto name = static_cast<std::size_t>(axis);
    svg += fmt::format("<path stroke=\"{}\" stroke-width=\"1.8\" d=\"", colours[name]);
    const char* step = "M";
    for (const PlanPoint& q : map.along) {
      const double value = axis < 3 ? q.sigma_m[axis] : q.total_m;
      svg += fmt::format("{}{:.1f} {:.1f}", step, p.u(q.point_m.z()), p.v(1e3 * value));
      step = "L";
    }
    svg += fmt::format("\"/>\n<g fill=\"{}\">", colours[name]);
    svg += label(p.left_px + 12.0, kTop_px + 20.0 + 16.0 * axis, names[name], "start") + "</g>";
  }
  return svg + frame(p, "expected error in the middle of the field", "distance z [m]", "mm");
}

/// One camera from above: what it sees, as a triangle, and the camera as a dot.
std::string sight(const Panel& p, const Pose& mMc, const CameraModel& camera, double reach_m) {
  const Eigen::Vector3d at = mMc.translation();
  std::string svg =
      fmt::format("<path class=\"sight\" d=\"M{:.1f} {:.1f}", p.u(at.x()), p.v(at.z()));
  for (const double column : {0.0, camera.width - 1.0}) {
    const Eigen::Vector3d ray((column - camera.K(0, 2)) / camera.K(0, 0), 0.0, 1.0);
    const Eigen::Vector3d d = mMc.linear() * ray;
    const Eigen::Vector3d end = at + d * (reach_m / d.z());
    svg += fmt::format("L{:.1f} {:.1f}", p.u(end.x()), p.v(end.z()));
  }
  return svg + fmt::format("Z\"/><circle fill=\"#1c2733\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>\n",
                           p.u(at.x()), p.v(at.z()));
}

std::string abovePanel(const PlanView& view, const PlanMap& map) {
  const double top = map.along.back().point_m.z();
  const Panel p{850.0, -0.5 * top, 0.5 * top, 0.0, top};
  const Pose mMc1 = view.c1Mm.inverse();
  std::string svg = fmt::format(
      "<clipPath id=\"above\"><rect x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{2}\"/></clipPath>"
      "<g clip-path=\"url(#above)\">",
      p.left_px, kTop_px, kPanel_px);
  svg += sight(p, mMc1, view.rig.left, 1.2 * top);
  svg += sight(p, mMc1 * view.rig.c2Mc1.inverse(), *view.rig.right, 1.2 * top);
  if (map.box) {
    const Eigen::Vector3d low = map.box->centre_m - 0.5 * map.box->size_m;
    const Eigen::Vector3d high = map.box->centre_m + 0.5 * map.box->size_m;
    svg += fmt::format("<path class=\"box\" d=\"M{0:.1f} {1:.1f}H{2:.1f}V{3:.1f}H{0:.1f}Z\"/>",
                       p.u(low.x()), p.v(low.z()), p.u(high.x()), p.v(high.z()));
  }
  svg += fmt::format("<path class=\"box\" d=\"M{:.1f} {:.1f}H{:.1f}\"/></g>\n",
                     p.u(map.field.low_m.x()), p.v(map.distance_m), p.u(map.field.high_m.x()));
  return svg + frame(p, "the cameras from above, and what both see", "x [m]", "z [m]");
}

}  // namespace

std::string planPicture(const PlanView& view, const PlanMap& map) {
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1180 420\" width=\"1180\" "
      "height=\"420\" font-family=\"sans-serif\" font-size=\"12\" fill=\"none\" "
      "stroke=\"#1c2733\">\n<style>.sight{fill:#1668b8;fill-opacity:.13;stroke:#8aa}"
      ".box{stroke:#d1542a;stroke-width:1.8}text{fill:#1c2733;stroke:none}"
      "g[fill] text{fill:inherit}</style>\n"
      "<rect width=\"1180\" height=\"420\" fill=\"#fff\" stroke=\"none\"/>\n";
  if (map.middle) {
    svg += acrossPanel(map);
  }
  if (!map.along.empty()) {
    svg += alongPanel(map) + abovePanel(view, map);
  }
  return svg + "</svg>\n";
}

}  // namespace ringhook
