#include "seen_motion.h"

#include <array>
#include <cmath>
#include <numbers>

namespace ringhook::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double wave(double t, double hz, double phase) {
  return std::sin(2.0 * std::numbers::pi * hz * t + phase);
}

/// Camera at `eye` that looks along -x_f: x along y_f, y down.
Pose watching(const Vector3d& eye) {
  Pose fMc = Pose::Identity();
  fMc.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  fMc.translation() = eye;
  return fMc;
}

/// Corners of two tags of 32 mm, one above the other.
std::vector<Vector3d> plateCorners() {
  std::vector<Vector3d> corners;
  for (const double y : {-0.022, 0.022}) {
    for (const Vector2d& c : {Vector2d(-1, -1), Vector2d(1, -1), Vector2d(1, 1), Vector2d(-1, 1)}) {
      corners.emplace_back(0.016 * c.x(), y + 0.016 * c.y(), 0.0);
    }
  }
  return corners;
}

/// Faces the cameras: x_g along y_f, y_g down, z_g away from them.
Pose platePose() {
  Pose eMg = Pose::Identity();
  eMg.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  eMg.translation() = Vector3d(0.05, 0.01, 0.09);
  return eMg;
}

}  // namespace

Pose flangeAt(double t, double amplitude_m) {
  const double turn = 3.0 * amplitude_m;
  const Vector3d position(0.3 + amplitude_m * wave(t, 0.53, 0.1),
                          amplitude_m * (wave(t, 0.91, 1.0) + 0.5 * wave(t, 1.37, 0.4)),
                          0.7 + amplitude_m * wave(t, 1.13, 2.0));
  const Vector3d rotation(turn * wave(t, 0.71, 0.5), turn * wave(t, 1.01, 1.4),
                          turn * wave(t, 0.61, 2.2));
  return makePoseThetaU(position, rotation);
}

PlateMotion seenMotion(const SeenMotionSettings& s) {
  std::mt19937_64 bits(s.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const Pose fMc1 = watching({1.7, -0.2, 0.7});
  const Pose fMc2 = watching({1.7, 0.2, 0.7});
  const std::array<Pose, 2> eyes = {fMc1, fMc2};
  PlateMotion motion;
  motion.fMc1 = fMc1 * makePoseThetaU(Vector3d::Constant(s.told_wrong_m),
                                      Vector3d::Constant(s.told_wrong_rad));
  for (double t = 0.0; t < s.seconds; t += 0.004) {
    Pose fMe = flangeAt(t, s.amplitude_m);
    fMe.translation() += s.joint_noise_m * Vector3d(normal(bits), normal(bits), normal(bits));
    motion.flange.push_back({Time::fromSeconds(10.0 + t + s.arm_delay_s), fMe});
  }
  for (double t = 0.2; t < s.seconds - 0.2; t += 0.02) {
    HookView view;
    view.time = Time::fromSeconds(10.0 + t + s.camera_delay_s);
    const Pose fMg = flangeAt(t, s.amplitude_m) * platePose();
    view.c1Mo_start = fMc1.inverse() * fMg *
                      makePoseThetaU(0.002 * Vector3d(normal(bits), normal(bits), normal(bits)),
                                     0.02 * Vector3d(normal(bits), normal(bits), normal(bits)));
    for (const Pose& fMc : eyes) {
      CameraFeatures features;
      features.camera = {2500.0, 2500.0, 1020.0, 1023.0, 2048, 2048, fMc.inverse() * fMc1};
      for (const Vector3d& corner : plateCorners()) {
        const Vector3d p = fMc.inverse() * fMg * corner;
        Vector2d pixel(2500.0 * p.x() / p.z() + 1020.0, 2500.0 * p.y() / p.z() + 1023.0);
        pixel += s.noise_px * Vector2d(normal(bits), normal(bits));
        if (uniform(bits) < s.wild_share) {
          pixel += Vector2d(20.0, -12.0);
        }
        features.corners.push_back({corner, pixel, 0.06});
      }
      view.cameras.push_back(features);
    }
    motion.plate.push_back(view);
  }
  return motion;
}

}  // namespace ringhook::test
