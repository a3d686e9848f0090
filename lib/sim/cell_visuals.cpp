#include "sim/cell_visuals.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "sim/arm_visuals.h"
#include "sim/cell_model.h"
#include "sim/clutter.h"
#include "sim/hook_shape.h"
#include "sim/mjcf_text.h"
#include "sim/scene_dice.h"
#include "sim/visual_geom.h"
#include "sim/wall_picture.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;

constexpr double kTexel = 0.001;  // of the printed plates [m]
constexpr int kBoardBorder = 1;   // white squares around the checkerboard
constexpr double kBoardHalfThickness = 0.003;

// MuJoCo wants a mass in every body, even in one that never moves.
constexpr const char* kSomeMass = R"(<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)"
                                  "\n";

TagPlateFace hookPlateFace() {
  const HookShape shape;
  return {shape.plate_width, shape.plate_height, shape.tag_size, shape.tag_distance, {0, 1}};
}

bool hasBoard(const BoardOptions& board) { return board.columns > 0 && board.rows > 0; }

/// One texel a square.
GrayImage boardPicture(const BoardOptions& board) {
  GrayImage picture(board.columns + 1 + 2 * kBoardBorder, board.rows + 1 + 2 * kBoardBorder, 255);
  for (int y = kBoardBorder; y < picture.height - kBoardBorder; ++y) {
    for (int x = kBoardBorder; x < picture.width - kBoardBorder; ++x) {
      picture.row(y)[x] = (x + y) % 2 == 0 ? 0 : 255;
    }
  }
  return picture;
}

/// A body of its own (frame t), which someone holds: it can be put anywhere between two exposures.
std::string boardXml(const BoardOptions& board) {
  Pose tMb(Eigen::AngleAxisd(EIGEN_PI, Vector3d::UnitX()));  // printed side is the box's +z
  tMb.translation() = Vector3d{0.5 * (board.columns - 1) * board.square,
                               0.5 * (board.rows - 1) * board.square, kBoardHalfThickness};
  const GrayImage face = boardPicture(board);
  const Vector3d half{0.5 * face.width * board.square, 0.5 * face.height * board.square,
                      kBoardHalfThickness};
  return "<body name=\"board\" mocap=\"true\"" + placing(board.fMt) + ">\n" + kSomeMass +
         visualBox(tMb, half, "board") + "</body>\n";
}

std::string textureXml(const std::string& name, int width, int height) {
  std::ostringstream text;
  text << "<texture name=\"" << name << "\" type=\"2d\" builtin=\"flat\" width=\"" << width
       << "\" height=\"" << height << "\" rgb1=\"1 1 1\"/>\n";
  return text.str();
}

std::string materialXml(const char* name, const char* look, double specular, double shininess) {
  std::ostringstream text;
  text << "<material name=\"" << name << "\" " << look << " specular=\"" << specular
       << "\" shininess=\"" << shininess << "\"/>\n";
  return text.str();
}

/// Printed patterns reflect between ink's and paper's share of the light.
GrayImage inked(GrayImage picture) {
  constexpr int kInk = 22;
  constexpr int kPaper = 235;
  for (std::uint8_t& value : picture.pixels) {
    value = value > 0 ? kPaper : kInk;
  }
  return picture;
}

void paint(mjModel& model, const char* name, const GrayImage& picture) {
  const int id = mj_name2id(&model, mjOBJ_TEXTURE, name);
  if (id < 0 || model.tex_width[id] != picture.width || model.tex_height[id] != picture.height) {
    return;
  }
  mjtByte* texel = model.tex_rgb + model.tex_adr[id];
  for (const std::uint8_t value : picture.pixels) {
    texel = std::fill_n(texel, 3, value);
  }
}

/// The rod on which the feeder's rings wait.
std::string magazineXml() {
  const Vector3d foot(magazinePose(0).translation().x(), magazinePose(0).translation().y(), 0.0);
  return visualCylinder(foot, foot + Vector3d(0, 0, 0.02), 0.06, "arm_dark") +
         visualCylinder(foot + Vector3d(0, 0, 0.02), foot + Vector3d(0, 0, 0.70), 0.006, "metal");
}

std::string occluderXml(const OccluderOptions& options, int index) {
  constexpr double kTop = 1.20;
  constexpr double kBottom = 0.35;
  const double radius = 0.5 * options.width;
  std::ostringstream text;
  text << "<body name=\"occluder" << index << "\" mocap=\"true\" pos=\"0 0 -5\">\n"
       << kSomeMass << visualCylinder({0, 0, kBottom}, {0, 0, kTop}, radius, "metal")
       << visualCylinder({0, 0, kBottom - 0.02}, {0, 0, kBottom}, 1.6 * radius, "arm_dark")
       << visualBox({0, 0, kTop}, {0.03, 0.06, 0.02}, "belt") << "</body>\n";
  return text.str();
}

}  // namespace

std::string visualSettingsXml() {
  return R"(<headlight active="0"/>
<global offwidth="16" offheight="16"/>
<quality shadowsize="0" offsamples="0" numslices="4" numstacks="4" numquads="1"/>
)";
}

std::string visualAssetXml(const SceneOptions& options) {
  const double s = options.specular;
  const GrayImage hook = drawTagPlate(hookPlateFace(), kTexel);
  const GrayImage gripper = drawTagPlate(gripperPlateFace(), kTexel);
  const int wall = wallTexels(options.wall);
  std::string text = textureXml("print_hook", hook.width, hook.height) +
                     textureXml("print_gripper", gripper.width, gripper.height) +
                     textureXml("wall", wall, wall);
  if (hasBoard(options.board)) {
    const GrayImage board = boardPicture(options.board);
    text += textureXml("print_board", board.width, board.height) +
            materialXml("board", R"(texture="print_board")", 0.0, 0.0);
  }
  return text + materialXml("tag_plate", R"(texture="print_hook")", 0.0, 0.0) +
         materialXml("gripper_plate", R"(texture="print_gripper")", 0.0, 0.0) +
         materialXml("wall", R"(texture="wall" texrepeat="2 1.25")", 0.0, 0.0) +
         materialXml("floor", R"(rgba="0.30 0.29 0.28 1")", 0.0, 0.0) +
         materialXml("steel", R"(rgba="0.62 0.63 0.65 1")", 0.22 * s, 0.30) +
         materialXml("metal", R"(rgba="0.55 0.56 0.58 1")", 0.25 * s, 0.45) +
         materialXml("arm", R"(rgba="0.85 0.42 0.08 1")", 0.0, 0.0) +
         materialXml("arm_dark", R"(rgba="0.13 0.13 0.14 1")", 0.0, 0.0) +
         materialXml("paint", R"(rgba="0.35 0.42 0.40 1")", 0.0, 0.0) +
         materialXml("gripper", R"(rgba="0.22 0.23 0.25 1")", 0.0, 0.0) +
         materialXml("ring", R"(rgba="0.68 0.69 0.71 1")", 0.30 * s, 0.50) +
         materialXml("belt", R"(rgba="0.16 0.17 0.19 1")", 0.0, 0.0);
}

std::string sceneVisualXml(const SceneOptions& options, std::uint64_t cell_seed) {
  SceneDice dice(options, cell_seed, SceneStream::wall_tone);
  const double tone = dice.between(0.45, 0.55);
  std::ostringstream colour;
  colour << std::setprecision(17) << tone << ' ' << 0.94 * tone << ' ' << 0.86 * tone << " 1";
  Pose fMwall(Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5));  // its own z towards the cameras
  fMwall.translation() = Vector3d(-0.95, 0.0, 1.2);
  std::string text = std::string("<body name=\"scenery\">\n") + kSomeMass + magazineXml() +
                     visualBox(fMwall, {4.0, 2.5, 0.01}, "wall", colour.str()) +
                     clutterXml(options, cell_seed);
  text += "</body>\n";
  if (hasBoard(options.board)) {
    text += boardXml(options.board);
  }
  for (int i = 0; i < options.occluder.count; ++i) {
    text += occluderXml(options.occluder, i);
  }
  return text;
}

std::string tagPlateXml() {
  // The box's own axes: x as y_o, y as z_o, z as x_o; its printed side lies at plate_face_x.
  const HookShape shape;
  const double back = shape.bar_thickness / 2.0;
  const double half = (shape.plate_face_x - back) / 2.0;
  Pose oMbox(Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5));
  oMbox.translation() = Vector3d(back + half, -shape.arc_radius, shape.plate_centre_z);
  return visualBox(oMbox, {shape.plate_width / 2.0, shape.plate_height / 2.0, half}, "tag_plate");
}

void paintTextures(mjModel_& model, const SceneOptions& options, std::uint64_t cell_seed) {
  paint(model, "print_hook", inked(drawTagPlate(hookPlateFace(), kTexel)));
  paint(model, "print_gripper", inked(drawTagPlate(gripperPlateFace(), kTexel)));
  paint(model, "print_board", inked(boardPicture(options.board)));
  paint(model, "wall", wallPicture(options, cell_seed));
}

}  // namespace ringhook
