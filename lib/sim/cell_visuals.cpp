#include "sim/cell_visuals.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <sstream>
#include <vector>

#include "sim/hook_shape.h"
#include "sim/tag_pattern.h"

namespace ringhook {
namespace {

constexpr double kTexel = 0.0005;  // of the printed plate [m]
constexpr int kWallTexels = 256;   // along each side of the wall

TagPlateFace plateFace() {
  const HookShape shape;
  return {shape.plate_width, shape.plate_height, shape.tag_size, shape.tag_distance, {0, 1}};
}

/// Grey value at a texel (column, row) of a texture.
using Painter = std::function<int(int, int)>;

void paint(mjModel& model, const char* name, const Painter& painter) {
  const int id = mj_name2id(&model, mjOBJ_TEXTURE, name);
  if (id < 0) {
    return;
  }
  mjtByte* texel = model.tex_rgb + model.tex_adr[id];
  for (int y = 0; y < model.tex_height[id]; ++y) {
    for (int x = 0; x < model.tex_width[id]; ++x, texel += 3) {
      std::fill_n(texel, 3, static_cast<mjtByte>(std::clamp(painter(x, y), 0, 255)));
    }
  }
}

/// Smoothed noise of mean 0, periodic over the texture: a mildly stained wall.
std::vector<double> stains(std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  constexpr int n = kWallTexels;
  std::vector<double> field(static_cast<std::size_t>(n * n));
  for (double& value : field) {
    value = static_cast<double>(bits() >> 11U) * 0x1p-53 - 0.5;
  }
  const auto at = [](int x, int y) {
    return static_cast<std::size_t>((y & (n - 1)) * n + (x & (n - 1)));
  };
  for (const int reach : {1, 2, 4}) {
    std::vector<double> smooth(field.size());
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        smooth[at(x, y)] =
            0.2 * (field[at(x, y)] + field[at(x + reach, y)] + field[at(x - reach, y)] +
                   field[at(x, y + reach)] + field[at(x, y - reach)]);
      }
    }
    field = std::move(smooth);
  }
  return field;
}

}  // namespace

std::string visualSettingsXml() {
  return R"(<headlight active="0"/>
<global offwidth="16" offheight="16"/>
<quality shadowsize="0" offsamples="0" numslices="16" numstacks="8" numquads="4"/>
)";
}

std::string visualAssetXml() {
  const GrayImage face = drawTagPlate(plateFace(), kTexel);
  std::ostringstream text;
  text << "<texture name=\"tag_plate\" type=\"2d\" builtin=\"flat\" width=\"" << face.width
       << "\" height=\"" << face.height << "\" rgb1=\"1 1 1\"/>\n"
       << "<texture name=\"wall\" type=\"2d\" builtin=\"flat\" width=\"" << kWallTexels
       << "\" height=\"" << kWallTexels << "\" rgb1=\"1 1 1\"/>\n"
       << R"(<material name="tag_plate" texture="tag_plate" specular="0" shininess="0"/>
<material name="wall" texture="wall" specular="0" shininess="0"/>
<material name="floor" rgba="0.30 0.29 0.28 1" specular="0" shininess="0"/>
<material name="steel" rgba="0.74 0.75 0.77 1" specular="0.3" shininess="0.3"/>
<material name="arm" rgba="0.85 0.42 0.08 1" specular="0.2" shininess="0.4"/>
<material name="gripper" rgba="0.22 0.23 0.25 1" specular="0.2" shininess="0.3"/>
<material name="ring" rgba="0.80 0.81 0.83 1" specular="0.4" shininess="0.5"/>
<material name="belt" rgba="0.16 0.17 0.19 1" specular="0.1" shininess="0.2"/>
<material name="plate" rgba="0.90 0.90 0.90 1" specular="0" shininess="0"/>
)";
  return text.str();
}

std::string sceneVisualXml(std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  const auto spread = [&bits](double mean, double by) {
    return mean + by * (2.0 * static_cast<double>(bits() >> 11U) * 0x1p-53 - 1.0);
  };
  const double main_lamp = spread(0.62, 0.05);
  const double side_lamp = spread(0.22, 0.04);
  const double tone = spread(0.50, 0.05);
  std::ostringstream text;
  const auto lamp = [&text](const char* direction, double brightness, double ambient) {
    text << "<light directional=\"true\" castshadow=\"false\" pos=\"0 0 3\" dir=\"" << direction
         << "\" diffuse=\"" << brightness << ' ' << brightness << ' ' << brightness
         << "\" ambient=\"" << ambient << ' ' << ambient << ' ' << ambient
         << "\" specular=\"0.2 0.2 0.2\"/>\n";
  };
  lamp("-0.85 0.25 -0.45", main_lamp, 0.20);
  lamp("-0.50 -0.80 -0.35", side_lamp, 0.0);
  text << "<geom name=\"wall\" type=\"box\" pos=\"-0.95 0 1.2\" quat=\"0.5 0.5 0.5 0.5\""
       << " size=\"4 2.5 0.01\" contype=\"0\" conaffinity=\"0\" material=\"wall\" rgba=\"" << tone
       << ' ' << 0.94 * tone << ' ' << 0.86 * tone << " 1\"/>\n";
  return text.str();
}

std::string tagPlateXml() {
  // The box's own axes: x as y_o, y as z_o, z as x_o; its printed side lies at plate_face_x.
  const HookShape shape;
  const double back = shape.bar_thickness / 2.0;
  const double half = (shape.plate_face_x - back) / 2.0;
  std::ostringstream text;
  text << "<geom type=\"box\" mass=\"0\" contype=\"0\" conaffinity=\"0\" pos=\"" << back + half
       << ' ' << -shape.arc_radius << ' ' << shape.plate_centre_z
       << "\" quat=\"0.5 0.5 0.5 0.5\" size=\"" << shape.plate_width / 2.0 << ' '
       << shape.plate_height / 2.0 << ' ' << half << "\" material=\"tag_plate\"/>\n";
  return text.str();
}

void paintTextures(mjModel& model, std::uint64_t seed) {
  constexpr int kInk = 22;  // printed black still reflects
  constexpr int kPaper = 235;
  constexpr int kWallMean = 205;
  constexpr double kWallContrast = 400.0;
  const GrayImage face = drawTagPlate(plateFace(), kTexel);
  paint(model, "tag_plate", [&](int x, int y) { return face.row(y)[x] > 0 ? kPaper : kInk; });
  const std::vector<double> field = stains(seed);
  paint(model, "wall", [&](int x, int y) {
    const double stain = field[static_cast<std::size_t>(y * kWallTexels + x)];
    return kWallMean + static_cast<int>(std::lround(kWallContrast * stain));
  });
}

}  // namespace ringhook
