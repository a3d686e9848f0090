// Blur against its closed form: an edge that moves by L px during the exposure shows a ramp whose
// derivative has the variance of the resting edge's plus L^2 / 12, and whose centre lies where the
// edge was at mid-exposure.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "scene_view.h"
#include "sim/nominal_rig.h"
#include "sim/sim_stereo_camera.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Ramp {
  double centre = 0.0;    ///< from the lens model's edge at mid-exposure, outwards [px]
  double variance = 0.0;  ///< of the ramp's derivative [px^2]
  double motion = 0.0;    ///< of the edge across itself during the exposure, by the truth [px]
};

double grey(const StereoFrame& frame, const Vector2d& at) {
  const Vector2d p = at - Vector2d(frame.left_window.x, frame.left_window.y);
  const auto x = static_cast<int>(p.x());
  const auto y = static_cast<int>(p.y());
  const double s = p.x() - x;
  const double t = p.y() - y;
  const std::uint8_t* upper = frame.left.row(y) + x;
  const std::uint8_t* lower = frame.left.row(y + 1) + x;
  return (1.0 - t) * ((1.0 - s) * upper[0] + s * upper[1]) +
         t * ((1.0 - s) * lower[0] + s * lower[1]);
}

/// The left side of the hook's upper tag, in a frame with that exposure.
Ramp rampOf(double exposure_s) {
  const StereoRig rig = nominalRig();
  CellOptions options = hookInView(-0.1);
  options.belt.speed = 0.30;
  options.hook.swing_about_x = options.hook.swing_about_y = 0.0;
  options.scene.light.brightness = std::min(0.8, 0.0004 / exposure_s);
  CellWorld world(options);
  SimCameraOptions camera_options;
  camera_options.rate_hz = 2.0;
  camera_options.sensor.exposure_s = exposure_s;
  camera_options.sensor.gain = std::max(1.0, 0.0005 / exposure_s);
  camera_options.sensor.noise = false;
  SimStereoCamera camera(world, rig, camera_options);
  camera.setWindows({0, 0, 2, 2}, {0, 0, 2, 2});
  world.advanceTo(Time::fromSeconds(0.49));
  camera.setWindows({500, 500, 700, 700}, {0, 0, 2, 2});
  world.advanceTo(Time::fromSeconds(0.5));
  const HookTruth hook = truth(world).hooks.front();
  const StereoFrame frame = frameAt(world, camera, 0.51);
  const Pose c1Mo = rig.fMc1->inverse() * hook.fMo;
  const auto corners = tagCorners(0);
  const Vector2d upper = projected(rig.left, c1Mo, corners[0]);
  const Vector2d lower = projected(rig.left, c1Mo, corners[3]);
  const Vector2d along = (lower - upper).normalized();
  const Vector2d outwards(-along.y(), along.x());  // to the left of the way down is outside

  constexpr double kStep = 0.1;
  constexpr int kReach = 55;  // steps to each side
  std::vector<double> profile(2 * kReach + 1, 0.0);
  int lines = 0;
  for (double s = 0.15; s < 0.85; s += 0.004, ++lines) {
    const Vector2d at = projected(rig.left, c1Mo, corners[0] + s * (corners[3] - corners[0]));
    for (int i = -kReach; i <= kReach; ++i) {
      profile[static_cast<std::size_t>(i + kReach)] += grey(frame, at + kStep * i * outwards);
    }
  }
  Ramp ramp;
  double weight = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const double rise = profile[i] - profile[i - 1];
    const double t = kStep * (static_cast<double>(i) - 0.5 - kReach);
    weight += rise;
    first += rise * t;
    second += rise * t * t;
  }
  ramp.centre = first / weight;
  ramp.variance = second / weight - ramp.centre * ramp.centre;
  Pose moved = hook.fMo;
  moved.translation() += exposure_s * hook.twist_f.head<3>();
  const Vector3d middle = 0.5 * (corners[0] + corners[3]);
  const Vector2d way =
      projected(rig.left, rig.fMc1->inverse() * moved, middle) - projected(rig.left, c1Mo, middle);
  ramp.motion = way.dot(outwards);
  return ramp;
}

TEST(MotionBlur, MakesARampOfTheWayAroundMidExposure) {
  const Ramp sharp = rampOf(1e-6);
  EXPECT_NEAR(sharp.centre, 0.0, 0.02);
  for (const double exposure_s : {0.0005, 0.002, 0.006, 0.009}) {
    const Ramp ramp = rampOf(exposure_s);
    const double added = std::max(0.0, ramp.variance - sharp.variance);
    const double motion = std::abs(ramp.motion);
    std::cout << 1e3 * exposure_s << " ms: moves " << motion << " px, ramp as of "
              << std::sqrt(12.0 * added) << " px, centre off by " << ramp.centre << " px\n";
    EXPECT_NEAR(ramp.centre, 0.0, 0.025);
    if (motion > 3.0) {
      EXPECT_NEAR(std::sqrt(12.0 * added) / motion, 1.0, 0.04);
    } else {  // the pixel grid alone widens a ramp by up to this, depending on where it lies
      EXPECT_NEAR(added, motion * motion / 12.0, 1.0 / 12.0);
    }
  }
}

}  // namespace
}  // namespace ringhook
