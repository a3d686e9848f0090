#include "app/model.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "app/options.h"
#include "core/angle.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "sim/hook_shape.h"
#include "tracking/mesh_model.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

struct HookArguments {
  HookShape shape;
  std::string out;
  std::string json;
};

void writeHook(const HookArguments& arguments) {
  checkHookShape(arguments.shape);
  JsonFile summary(arguments.json);
  const fs::path folder = arguments.out;
  writeFileAtomically(folder / "hook.cao", hookCao(arguments.shape));
  writeFileAtomically(folder / "hook.obj", hookObj(arguments.shape));
  writeFileAtomically(folder / "marker.yaml", markerYaml(arguments.shape));
  nlohmann::ordered_json json;
  json["folder"] = folder.string();
  json["files"] = {"hook.cao", "hook.obj", "marker.yaml"};
  summary.commit(json.dump(2) + "\n");
  std::printf("written: %s (hook.cao, hook.obj, marker.yaml)\n", folder.string().c_str());
}

/// A length of the hook, told in millimetres, kept in metres.
struct Measure {
  const char* name;
  double HookShape::*length;
  const char* what;
};

constexpr Measure kMeasures[] = {
    {"bar-width", &HookShape::bar_width, "Of the bar, as the cameras see it"},
    {"bar-thickness", &HookShape::bar_thickness, "Of the bar, towards the cameras"},
    {"arc-radius", &HookShape::arc_radius, "Of the J's centreline"},
    {"shank-length", &HookShape::shank_length, "From the arc's centre to the pivot"},
    {"tip-rise", &HookShape::tip_rise, "Of the tip above the arc's centre"},
    {"plate-width", &HookShape::plate_width, "Of the tag plate"},
    {"plate-height", &HookShape::plate_height, "Of the tag plate"},
    {"plate-face", &HookShape::plate_face_x, "Its printed face before the bar's middle"},
    {"plate-centre", &HookShape::plate_centre_z, "Its centre above the arc's centre"},
    {"tag-size", &HookShape::tag_size, "Side of a tag's black square"},
    {"tag-distance", &HookShape::tag_distance, "Between the tags' centres"},
    {"tracked-top", &HookShape::tracked_top, "Where the edge model ends"}};

void addMeasure(CLI::App& command, const Measure& measure, HookShape& shape) {
  double& metres = shape.*measure.length;
  std::ostringstream what;
  what << measure.what << "; default " << 1e3 * metres;
  command
      .add_option_function<double>(
          "--" + std::string(measure.name) + "-mm",
          [&metres](double value) { metres = value / 1e3; }, what.str())
      ->type_name("MM");
}

void addHookCommand(CLI::App& model) {
  auto arguments = std::make_shared<HookArguments>();
  CLI::App& command =
      addCommand(model, "hook",
                 "Writes the models of a J-shaped hook: edges, solid and tag plate from one source",
                 "Example: ringhook model hook --arc-radius-mm 40 --out models/wide-hook\n"
                 "Then name hook.cao and marker.yaml in the cell file (doc/models.md).");
  HookShape& shape = arguments->shape;
  for (const Measure& measure : kMeasures) {
    addMeasure(command, measure, shape);
  }
  command.add_option("--arc-chords", shape.arc_chords, "Chords for each side of the arc")
      ->capture_default_str();
  command.add_option("--out", arguments->out, "Folder for the three files")
      ->required()
      ->type_name("DIR");
  addJsonOption(command, arguments->json, "Also write what was made here");
  command.callback([arguments] { writeHook(*arguments); });
}

struct ConvertArguments {
  std::string file;
  std::string out;
  std::string json;
  double feature_angle_deg = 30.0;
  double chord_tolerance_mm = 0.1;
  double weld_mm = 0.001;
  double scale = 1.0;
};

std::string convertJson(const ConvertArguments& arguments, const MeshModel& model) {
  nlohmann::ordered_json json;
  json["model"] = arguments.out;
  json["extents_m"] = {model.extents_m.x(), model.extents_m.y(), model.extents_m.z()};
  json["lines"] = model.lines;
  json["flat_faces"] = model.flat_faces;
  json["hole_faces"] = model.hole_faces;
  json["thread_faces"] = model.thread_faces;
  json["left_out"] = model.left_out;
  json["welded_points"] = model.repair.welded_points;
  json["dropped_faces"] = model.repair.dropped_faces;
  json["divided_sides"] = model.repair.divided_sides;
  json["turned_faces"] = model.repair.turned_faces;
  json["open_edges"] = model.repair.open_edges;
  json["crowded_edges"] = model.repair.crowded_edges;
  return json.dump(2) + "\n";
}

void note(int count, const char* what) {
  if (count > 0) {
    std::printf("note: %d %s\n", count, what);
  }
}

void printModel(const ConvertArguments& arguments, const MeshModel& model) {
  constexpr int kManyLines = 1000;
  std::printf("%.4g x %.4g x %.4g m, %d edges: %d flat faces, %d holes, %d threads along curves\n",
              model.extents_m.x(), model.extents_m.y(), model.extents_m.z(), model.lines,
              model.flat_faces, model.hole_faces, model.thread_faces);
  const RepairReport& repair = model.repair;
  note(repair.welded_points, "points stood where another one was");
  note(repair.dropped_faces, "faces had no area or were there twice");
  note(repair.divided_sides, "sides of faces had another face's corner on them");
  note(repair.turned_faces, "faces were wound inside out and are turned");
  note(repair.open_edges,
       "edges belong to one face only: an open surface is seen from the side of its winding");
  note(repair.crowded_edges, "edges belong to three faces or more");
  note(model.left_out, "faces are too small for ViSP to tell their direction and are left out");
  note(model.lines > kManyLines ? model.lines : 0,
       "edges are many for a tracker at frame rate: try a larger --chord-tolerance-mm");
  std::printf("written: %s\n", arguments.out.c_str());
}

void convert(const ConvertArguments& arguments) {
  if (fs::path(arguments.out).extension() != ".cao") {
    throw InputError("--out " + arguments.out + ": expected a name that ends in .cao");
  }
  JsonFile json(arguments.json);
  MeshModelOptions options;
  options.scale = arguments.scale;
  options.feature_angle = arguments.feature_angle_deg * kDegree;
  options.chord_tolerance_m = arguments.chord_tolerance_mm / 1e3;
  options.weld_m = arguments.weld_mm / 1e3;
  const MeshModel model = modelFromMesh(loadObj(arguments.file), options, arguments.file);
  writeFileAtomically(arguments.out, caoText(model, fs::path(arguments.file).filename().string()));
  json.commit(convertJson(arguments, model));
  printModel(arguments, model);
}

void addConvertCommand(CLI::App& model) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App& command = addCommand(
      model, "convert", "Turns a CAD mesh (Wavefront OBJ) into an edge model for ViSP (.cao)",
      "Example: ringhook model convert hook.obj --scale 0.001 --out hook.cao\n"
      "Then: ringhook evaluate sequence DIR --target hook.cao --start POSE (doc/models.md)");
  command.add_option("FILE", arguments->file, "Wavefront OBJ, text")->required();
  command.add_option("--out", arguments->out, "Edge model to write")
      ->required()
      ->type_name("FILE.cao");
  command
      .add_option("--scale", arguments->scale,
                  "Metres in one unit of the file: 0.001 for millimetres, 0.0254 for inches")
      ->check(CLI::Range(1e-9, 1e6))
      ->capture_default_str();
  command
      .add_option("--feature-angle-deg", arguments->feature_angle_deg,
                  "Faces that meet at this angle or more make an edge")
      ->check(CLI::Range(1.0, 180.0))
      ->capture_default_str();
  command
      .add_option("--chord-tolerance-mm", arguments->chord_tolerance_mm,
                  "Of the straight lines from the curved edges that they stand for")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command.add_option("--weld-mm", arguments->weld_mm, "Points nearer than this are one point")
      ->check(CLI::Range(1e-6, 10.0))
      ->capture_default_str();
  addJsonOption(command, arguments->json, "Also write the counts here");
  command.callback([arguments] { convert(*arguments); });
}

}  // namespace

void addModelCommand(CLI::App& app) {
  CLI::App& model =
      addCommand(app, "model", "Makes the models that the trackers use",
                 "Example: ringhook model convert part.obj --scale 0.001 --out part.cao");
  model.require_subcommand(1);
  addHookCommand(model);
  addConvertCommand(model);
}

}  // namespace ringhook
