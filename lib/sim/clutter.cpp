#include "sim/clutter.h"

#include <Eigen/Geometry>
#include <array>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "sim/hook_body.h"
#include "sim/scene_dice.h"
#include "sim/visual_geom.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;

constexpr double kArmFree = 0.30;  // |y| from which on a thing may stand on the floor [m]
constexpr int kKinds = 5;

const std::array<const char*, 3> kPipeLooks{"metal", "paint", "arm_dark"};

std::string tone(SceneDice& dice) {
  std::ostringstream text;
  const double grey = dice.between(0.10, 0.75);
  text << std::setprecision(17) << grey << ' ' << grey * dice.between(0.75, 1.0) << ' '
       << grey * dice.between(0.5, 1.0) << " 1";
  return text.str();
}

std::string crate(SceneDice& dice) {
  const double side = dice.below(2) == 0 ? -1.0 : 1.0;
  const Vector3d half{dice.between(0.06, 0.15), dice.between(0.06, 0.18), dice.between(0.05, 0.30)};
  Pose pose(Eigen::AngleAxisd(dice.between(0.0, std::numbers::pi), Vector3d::UnitZ()));
  pose.translation() =
      Vector3d{dice.between(-0.75, -0.15), side * dice.between(kArmFree + 0.1, 1.1), half.z()};
  return visualBox(pose, half, "paint", tone(dice));
}

std::string uprightPipe(SceneDice& dice) {
  const double x = dice.between(-0.90, -0.45);
  const double y = dice.between(-1.1, 1.1);
  return visualCylinder({x, y, 0.0}, {x, y, 1.6}, dice.between(0.008, 0.040),
                        kPipeLooks[static_cast<std::size_t>(dice.below(3))]);
}

std::string levelPipe(SceneDice& dice) {
  const double x = dice.between(-0.92, -0.70);
  const double z = dice.between(0.15, 1.25);
  const double slope = dice.between(-0.05, 0.05);
  return visualCylinder({x, -1.6, z - slope}, {x, 1.6, z + slope}, dice.between(0.006, 0.030),
                        kPipeLooks[static_cast<std::size_t>(dice.below(3))]);
}

/// Sags as a parabola between two fixings.
std::string cable(SceneDice& dice) {
  const Vector3d from{dice.between(-0.8, 0.2), dice.between(-1.1, 0.2), dice.between(1.0, 1.4)};
  const Vector3d to{from.x() + dice.between(-0.2, 0.1), from.y() + dice.between(0.3, 0.9),
                    dice.between(1.0, 1.4)};
  const double sag = dice.between(0.10, 0.45);
  const double radius = dice.between(0.002, 0.006);
  const auto at = [&](double s) {
    return Vector3d(from + s * (to - from) - Vector3d(0, 0, 4.0 * sag * s * (1.0 - s)));
  };
  constexpr int kPieces = 12;
  std::string text;
  for (int i = 0; i < kPieces; ++i) {
    text += visualCapsule(at(static_cast<double>(i) / kPieces),
                          at(static_cast<double>(i + 1) / kPieces), radius, "arm_dark");
  }
  return text;
}

/// Hangs from a rail behind the arm, turned about the vertical.
std::string idleHook(SceneDice& dice) {
  Pose fMh(Eigen::AngleAxisd(dice.between(-1.2, 1.2), Vector3d::UnitZ()));
  fMh.translation() =
      Vector3d{dice.between(-0.65, -0.20), dice.between(-0.9, 0.9), dice.between(0.45, 0.95)};
  std::string text;
  for (const HookPart& part : hookBars()) {
    Pose hMp(Eigen::AngleAxisd(part.angle_x, Vector3d::UnitX()));
    hMp.translation() = part.center_o;
    text += visualBox(fMh * hMp, part.half_size, "steel");
  }
  return text;
}

}  // namespace

std::string clutterXml(const SceneOptions& options, std::uint64_t cell_seed) {
  SceneDice dice(options, cell_seed, SceneStream::clutter);
  std::string text;
  for (int i = 0; i < options.clutter; ++i) {
    switch (i % kKinds) {
      case 0:
        text += idleHook(dice);
        break;
      case 1:
        text += crate(dice);
        break;
      case 2:
        text += uprightPipe(dice);
        break;
      case 3:
        text += cable(dice);
        break;
      default:
        text += levelPipe(dice);
        break;
    }
  }
  return text;
}

}  // namespace ringhook
