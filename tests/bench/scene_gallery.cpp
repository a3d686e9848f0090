// Full frames of the simulated cell's looks, to be looked at:
//   scene_gallery --out DIR

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>

#include "camera/image_file.h"
#include "core/error.h"
#include "sim/cell_world.h"
#include "sim/nominal_rig.h"
#include "sim/sim_stereo_camera.h"

namespace ringhook {
namespace {

struct Look {
  std::string name;
  SceneOptions scene;
  SensorOptions sensor;
  double time_s = 0.5;
};

std::vector<Look> looks() {
  std::vector<Look> all(7);
  all[0].name = "hall_plain";
  all[1].name = "side_plain";
  all[1].scene.light.setup = LightSetup::side;
  all[2].name = "hall_textured";
  all[2].scene.wall = WallKind::textured;
  all[3].name = "hall_cluttered";
  all[3].scene.wall = WallKind::textured;
  all[3].scene.clutter = 30;
  all[4].name = "side_cluttered";
  all[4].scene = all[3].scene;
  all[4].scene.light.setup = LightSetup::side;
  all[5].name = "dark_occluded";
  all[5].scene.light.brightness = 0.1;
  all[5].sensor.gain = 8.0;
  all[5].scene.occluder.count = 1;
  all[5].scene.occluder.first_s = 0.5;
  all[6].name = "long_exposure";
  all[6].sensor.exposure_s = 0.02;
  all[6].scene.light.brightness = 0.025;
  all[6].scene.occluder.count = 1;
  all[6].scene.occluder.first_s = 0.8;
  return all;
}

void save(const Look& look, const std::filesystem::path& folder) {
  CellOptions options;
  options.belt.start_y = options.belt.entry_y = -0.1;
  options.hook.swing_about_x = options.hook.swing_about_y = 0.2;
  options.scene = look.scene;
  CellWorld world(options);
  SimCameraOptions camera_options;
  camera_options.rate_hz = 1.0 / look.time_s;
  camera_options.sensor = look.sensor;
  SimStereoCamera camera(world, nominalRig(), camera_options);
  camera.setWindows({0, 0, 8, 8}, {0, 0, 8, 8});
  world.advanceTo(Time::fromSeconds(0.5 * look.time_s));
  camera.setWindows({}, {});
  world.advanceTo(Time::fromSeconds(look.time_s + 0.01));
  (void)camera.grab(0.0);
  const auto frame = camera.grab(0.0);
  if (!frame) {
    throw Error("no frame arrived");
  }
  writeGrayImage(folder / (look.name + "_left.png"), frame->left);
  writeGrayImage(folder / (look.name + "_right.png"), frame->right);
  Pose fMc = Pose::Identity();
  const Eigen::Vector3d eye(1.2, -1.0, 1.15);
  const Eigen::Vector3d z = (Eigen::Vector3d(0.15, 0.0, 0.60) - eye).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  fMc.linear() << x, z.cross(x), z;
  fMc.translation() = eye;
  camera.savePicture(folder / (look.name + "_beside.jpg"), fMc, 0.9, 1200, 900);
  std::cout << look.name << "\n";
}

}  // namespace
}  // namespace ringhook

int main(int argc, char** argv) {
  CLI::App app("Full frames of the simulated cell's looks, to be looked at");
  std::filesystem::path out = "gallery";
  std::string only;
  app.add_option("--out", out, "folder for the pictures")->capture_default_str();
  app.add_option("--only", only, "one look by name");
  CLI11_PARSE(app, argc, argv);
  try {
    std::filesystem::create_directories(out);
    for (const ringhook::Look& look : ringhook::looks()) {
      if (only.empty() || only == look.name) {
        ringhook::save(look, out);
      }
    }
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << "\n";
    return 1;
  }
  return 0;
}
