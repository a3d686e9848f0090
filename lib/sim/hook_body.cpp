#include "sim/hook_body.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace ringhook {
namespace {

constexpr int kArcSegments = 15;
constexpr double kAluminiumDensity = 2700.0;

double barMass(const HookShape& s, double length) {
  return kSteelDensity * s.bar_width * s.bar_thickness * length;
}

HookPart uprightBar(const HookShape& s, double y, double length) {
  return {{0.0, y, 0.5 * length},
          {0.5 * s.bar_thickness, 0.5 * s.bar_width, 0.5 * length},
          0.0,
          barMass(s, length)};
}

/// Inertia of a part about its own centre, axes of o.
Eigen::Matrix3d partInertia(const HookPart& part) {
  const Eigen::Vector3d side2 = (2.0 * part.half_size).array().square();
  const Eigen::Vector3d principal =
      part.mass / 12.0 *
      Eigen::Vector3d(side2.y() + side2.z(), side2.x() + side2.z(), side2.x() + side2.y());
  const Eigen::Matrix3d oRpart =
      Eigen::AngleAxisd(part.angle_x, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return oRpart * principal.asDiagonal() * oRpart.transpose();
}

Eigen::Matrix3d pointInertia(double mass, const Eigen::Vector3d& p) {
  return mass * (p.squaredNorm() * Eigen::Matrix3d::Identity() - p * p.transpose());
}

}  // namespace

std::vector<HookPart> hookBars(const HookShape& s) {
  std::vector<HookPart> parts{uprightBar(s, -s.arc_radius, s.shank_length),
                              uprightBar(s, s.arc_radius, s.tip_rise)};
  const double span = std::numbers::pi / kArcSegments;
  // Boxes as long as the arc's outside, so that neighbours overlap without a notch.
  const double half_length = (s.arc_radius + 0.5 * s.bar_width) * std::tan(0.5 * span);
  for (int i = 0; i < kArcSegments; ++i) {
    const double angle = -std::numbers::pi + (i + 0.5) * span;  // from the shank round to the tip
    HookPart part;
    part.center_o = s.arc_radius * Eigen::Vector3d(0.0, std::cos(angle), std::sin(angle));
    part.half_size = {0.5 * s.bar_thickness, half_length, 0.5 * s.bar_width};
    part.angle_x = angle + 0.5 * std::numbers::pi;
    part.mass = barMass(s, s.arc_radius * span);
    parts.push_back(part);
  }
  return parts;
}

std::vector<HookPart> hookPlates(const HookShape& s) {
  const double face = 0.5 * s.bar_thickness;
  const double thickness = s.plate_face_x - face;
  HookPart plate;
  plate.center_o = {face + 0.5 * thickness, -s.arc_radius, s.plate_centre_z};
  plate.half_size = {0.5 * thickness, 0.5 * s.plate_width, 0.5 * s.plate_height};
  plate.mass = kAluminiumDensity * thickness * s.plate_width * s.plate_height;
  // Strip of thickness t behind the bar with the same moment: rho b h t (face + t / 2).
  const double area_density = kSteelDensity * s.bar_width * s.plate_height;
  const double moment = plate.mass * plate.center_o.x();
  const double t = -face + std::sqrt(face * face + 2.0 * moment / area_density);
  HookPart strip;
  strip.center_o = {-face - 0.5 * t, -s.arc_radius, s.plate_centre_z};
  strip.half_size = {0.5 * t, 0.5 * s.bar_width, 0.5 * s.plate_height};
  strip.mass = area_density * t;
  return {plate, strip};
}

HookMass hookMass(const HookShape& s) {
  std::vector<HookPart> parts = hookBars(s);
  for (const HookPart& plate : hookPlates(s)) {
    parts.push_back(plate);
  }
  HookMass total;
  total.center_o.setZero();
  for (const HookPart& part : parts) {
    total.mass += part.mass;
    total.center_o += part.mass * part.center_o;
  }
  total.center_o /= total.mass;
  total.inertia_o.setZero();
  for (const HookPart& part : parts) {
    total.inertia_o += partInertia(part) + pointInertia(part.mass, part.center_o - total.center_o);
  }
  return total;
}

Eigen::Vector3d hookPivot(double height) { return {0.0, hookMass().center_o.y(), height}; }

double swingFrequency(double height, int axis) {
  const HookMass hook = hookMass();
  const Eigen::Vector3d arm = hook.center_o - hookPivot(height);
  const Eigen::Matrix3d inertia = hook.inertia_o + pointInertia(hook.mass, arm);
  return std::sqrt(hook.mass * kGravity * arm.norm() / inertia(axis, axis));
}

std::vector<Eigen::Vector3d> hookCentreline(const HookShape& s) {
  std::vector<Eigen::Vector3d> line{{0.0, s.arc_radius, s.tip_rise}};
  constexpr int kSteps = 36;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = -std::numbers::pi * i / kSteps;
    line.emplace_back(0.0, s.arc_radius * std::cos(angle), s.arc_radius * std::sin(angle));
  }
  line.emplace_back(0.0, -s.arc_radius, s.shank_length);
  return line;
}

}  // namespace ringhook
