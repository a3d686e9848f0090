#include "sim/scene_light.h"

#include <Eigen/Geometry>

#include "sim/scene_dice.h"

namespace ringhook {
namespace {

Eigen::Vector3d turned(const Eigen::Vector3d& direction, double spread, SceneDice& dice) {
  const Eigen::Vector3d turn{dice.between(-spread, spread), dice.between(-spread, spread),
                             dice.between(-spread, spread)};
  return (direction + turn.cross(direction)).normalized();
}

}  // namespace

SceneLight sceneLight(const SceneOptions& options, std::uint64_t cell_seed) {
  SceneDice dice(options, cell_seed, SceneStream::lamps);
  const LightOptions& chosen = options.light;
  SceneLight light;
  if (chosen.setup == LightSetup::hall) {
    light.towards_key = {0.72, -0.22, 0.66};
    light.towards_fill = {0.55, 0.80, 0.30};
    light.key = 0.90;
    light.fill = 0.26;
    light.sky = 0.34;
    light.ground = 0.20;
    light.tubes = 1.0;
  } else {
    light.towards_key = {0.60, 0.75, 0.28};
    light.towards_fill = {0.95, -0.20, 0.25};
    light.key = 1.30;
    light.fill = 0.20;
    light.sky = 0.14;
    light.ground = 0.09;
    light.tubes = 0.25;
  }
  light.towards_key = turned(light.towards_key.normalized(), chosen.direction_spread, dice);
  light.towards_fill = turned(light.towards_fill.normalized(), chosen.direction_spread, dice);
  light.key *= chosen.brightness * dice.factor(chosen.brightness_spread);
  light.fill *= chosen.brightness * dice.factor(chosen.brightness_spread);
  const double around = chosen.brightness * dice.factor(chosen.brightness_spread);
  light.sky *= around;
  light.ground *= around;
  light.tubes *= around;
  light.shadow_map_px = chosen.shadows ? chosen.shadow_map_px : 0;
  return light;
}

}  // namespace ringhook
