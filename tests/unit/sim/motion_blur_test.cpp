// Blur against its closed form: an edge that moves by L px during the exposure shows a ramp whose
// derivative has the variance of the resting edge's plus L^2 / 12, and whose centre lies where the
// edge was at mid-exposure.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "image_reader.h"
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

/// A hook that the belt carries, in a frame with some exposure.
struct MovingHook {
  StereoRig rig = nominalRig();
  HookTruth hook;  ///< at mid-exposure
  StereoFrame frame;
};

MovingHook movingHook(double exposure_s) {
  MovingHook seen;
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
  SimStereoCamera camera(world, seen.rig, camera_options);
  camera.setWindows({0, 0, 2, 2}, {0, 0, 2, 2});
  world.advanceTo(Time::fromSeconds(0.49));
  camera.setWindows({500, 500, 700, 700}, {0, 0, 2, 2});
  world.advanceTo(Time::fromSeconds(0.5));
  seen.hook = truth(world).hooks.front();
  seen.frame = frameAt(world, camera, 0.51);
  return seen;
}

constexpr double kStep = 0.1;  // of a profile [px]
constexpr int kReach = 55;     // steps to each side

/// Grey values across the line from `upper` to `lower`, points of o, added up along it.
std::vector<double> profileAcross(const MovingHook& seen, const Vector3d& upper,
                                  const Vector3d& lower, const Vector2d& outwards) {
  const Pose c1Mo = seen.rig.fMc1->inverse() * seen.hook.fMo;
  const Vector2d corner(seen.frame.left_window.x, seen.frame.left_window.y);
  std::vector<double> profile(2 * kReach + 1, 0.0);
  for (double s = 0.15; s < 0.85; s += 0.004) {
    const Vector2d at = projected(seen.rig.left, c1Mo, upper + s * (lower - upper)) - corner;
    for (int i = -kReach; i <= kReach; ++i) {
      profile[static_cast<std::size_t>(i + kReach)] +=
          greyAt(seen.frame.left, at + kStep * i * outwards);
    }
  }
  return profile;
}

/// Mean and variance of a profile's derivative.
Ramp momentsOf(const std::vector<double>& profile) {
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
  Ramp ramp;
  ramp.centre = first / weight;
  ramp.variance = second / weight - ramp.centre * ramp.centre;
  return ramp;
}

/// The left side of the hook's upper tag, in a frame with that exposure.
Ramp rampOf(double exposure_s) {
  const MovingHook seen = movingHook(exposure_s);
  const Pose c1Mf = seen.rig.fMc1->inverse();
  const auto corners = tagCorners(0);
  const auto pixelOf = [&](const Pose& fMo, const Vector3d& point_o) {
    return projected(seen.rig.left, c1Mf * fMo, point_o);
  };
  const Vector2d along =
      (pixelOf(seen.hook.fMo, corners[3]) - pixelOf(seen.hook.fMo, corners[0])).normalized();
  const Vector2d outwards(-along.y(), along.x());  // to the left of the way down is outside
  Ramp ramp = momentsOf(profileAcross(seen, corners[0], corners[3], outwards));
  Pose moved = seen.hook.fMo;
  moved.translation() += exposure_s * seen.hook.twist_f.head<3>();
  const Vector3d middle = 0.5 * (corners[0] + corners[3]);
  ramp.motion = (pixelOf(moved, middle) - pixelOf(seen.hook.fMo, middle)).dot(outwards);
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
