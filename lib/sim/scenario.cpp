#include "sim/scenario.h"

#include <cmath>

#include "core/angle.h"
#include "core/yaml_fields.h"

namespace ringhook {
namespace {

constexpr double kMilli = 1e-3;
constexpr double kLongest = 1e4;  // [s]; no run of a cell is longer

/// [from, to]
void updateRange(YamlFields& fields, const std::string& key, Range& range, double low,
                 double high) {
  std::vector<double> ends{range.low, range.high};
  fields.update(key, ends, 2, low, high);
  if (ends.size() != 2 || ends[0] > ends[1]) {
    fields.refuse(key, "[from, to], not falling");
  }
  range = {ends[0], ends[1]};
}

void readBelt(YamlFields fields, BeltOptions& belt) {
  fields.update("speed_m_s", belt.speed, 0.0, 1.0);
  fields.update("speed_spread", belt.speed_spread, 0.0, 0.5);
  fields.update("start_s", belt.start_s, 0.0, kLongest);
  fields.update("stops", belt.stops, 0, 1000);
  updateRange(fields, "run_s", belt.run_s, 0.0, kLongest);
  updateRange(fields, "stand_s", belt.stand_s, 0.0, kLongest);
  fields.update("acceleration_m_s2", belt.acceleration, 0.01, 10.0);
  fields.update("jerk_m_s3", belt.jerk, 0.01, 1000.0);
  fields.update("pitch_m", belt.pitch, 0.01, 1.0);
  fields.update("ripple", belt.ripple, 8, 0.0, 0.2);
  double sum = 0.0;
  for (const double fraction : belt.ripple) {
    sum += fraction;
  }
  if (sum >= 0.5) {
    fields.refuse("ripple", "fractions of the speed that sum up to less than 0.5");
  }
  fields.update("start_y_m", belt.start_y, -10.0, 10.0);
  fields.update("entry_y_m", belt.entry_y, -10.0, 10.0);
  fields.refuseUnknown();
}

void readHook(YamlFields fields, HookOptions& hook) {
  fields.update("count", hook.count, 1, 100);
  fields.update("spacing_m", hook.spacing, 0.2, 10.0);
  fields.update("swing_about_x_deg", hook.swing_about_x, 0.0, 30.0, kDegree);
  fields.update("swing_about_y_deg", hook.swing_about_y, 0.0, 30.0, kDegree);
  fields.update("swing_least", hook.swing_least, 0.0, 1.0);
  fields.update("length_spread", hook.length_spread, 0.0, 0.1);
  fields.update("pivot_friction_N_m", hook.pivot_friction, 0.0, 0.1);
  fields.update("pivot_damping_N_m_s", hook.pivot_damping, 0.0, 0.1);
  fields.update("damping_spread", hook.damping_spread, 0.0, 0.9);
  fields.refuseUnknown();
}

void readRing(YamlFields fields, RingOptions& ring) {
  fields.update("count", ring.count, 1, 100);
  fields.update("clearance_m", ring.clearance, 0.0005, 0.05);
  fields.update("friction", ring.friction, 0.0, 2.0);
  fields.refuseUnknown();
}

void readMachines(YamlFields& fields, CellOptions& cell) {
  if (fields.has("arm")) {
    YamlFields arm = fields.section("arm");
    arm.update("zero_error_sigma_deg", cell.arm.zero_error_sigma, 0.0, 1.0, kDegree);
    arm.refuseUnknown();
  }
  if (fields.has("gripper")) {
    YamlFields gripper = fields.section("gripper");
    gripper.update("feeder_clearance_m", cell.gripper.feeder_clearance, 0.0, 1.0);
    gripper.refuseUnknown();
  }
  if (fields.has("air")) {
    YamlFields air = fields.section("air");
    air.update("density_kg_m3", cell.air_density, 0.0, 10.0);
    air.update("viscosity_Pa_s", cell.air_viscosity, 0.0, 1.0);
    air.refuseUnknown();
  }
}

/// One word for each value of the enumeration, in its order.
template <class Kind>
void updateKind(YamlFields& fields, const std::string& key, Kind& kind,
                const std::vector<std::string>& words) {
  kind = fields.has(key) ? static_cast<Kind>(fields.choice(key, words)) : kind;
}

void readLight(YamlFields fields, LightOptions& light) {
  updateKind(fields, "setup", light.setup, {"hall", "side"});
  fields.update("brightness", light.brightness, 0.0, 10.0);
  fields.update("brightness_spread", light.brightness_spread, 0.0, 0.9);
  fields.update("direction_spread_deg", light.direction_spread, 0.0, 45.0, kDegree);
  fields.update("shadows", light.shadows);
  fields.update("shadow_map_px", light.shadow_map_px, 256, 4096);
  fields.refuseUnknown();
}

void readBackground(YamlFields fields, SceneOptions& scene) {
  updateKind(fields, "wall", scene.wall, {"plain", "textured"});
  fields.update("clutter", scene.clutter, 0, 60);
  fields.update("specular", scene.specular, 0.0, 5.0);
  int seed = static_cast<int>(scene.seed);
  fields.update("seed", seed, 0, 1'000'000'000);
  scene.seed = static_cast<std::uint64_t>(seed);
  fields.refuseUnknown();
}

void readOccluder(YamlFields fields, OccluderOptions& occluder) {
  fields.update("count", occluder.count, 0, 100);
  fields.update("speed_m_s", occluder.speed, 0.01, 5.0);
  fields.update("speed_spread", occluder.speed_spread, 0.0, 0.9);
  fields.update("width_m", occluder.width, 0.001, 0.5);
  fields.update("x_m", occluder.x, 0.5, 1.6);
  fields.update("first_s", occluder.first_s, 0.0, kLongest);
  fields.update("interval_s", occluder.interval_s, 0.1, kLongest);
  fields.refuseUnknown();
}

void readBoard(YamlFields fields, BoardOptions& board) {
  fields.update("columns", board.columns, 0, 50);
  fields.update("rows", board.rows, 0, 50);
  fields.update("square_m", board.square, 0.002, 0.2);
  if (fields.has("fMt")) {
    board.fMt = fields.pose("fMt");
  }
  fields.refuseUnknown();
}

void readCamera(YamlFields fields, SimCameraOptions& camera) {
  fields.update("rate_hz", camera.rate_hz, 0.1, 1000.0);
  fields.update("highest_rate_hz", camera.highest_rate_hz, 0.1, 1000.0);
  fields.update("transport_delay_ms", camera.transport_delay_s, 0.0, 1000.0, kMilli);
  fields.update("exposure_ms", camera.sensor.exposure_s, 0.01, 100.0, kMilli);
  fields.update("gain", camera.sensor.gain, 0.01, 100.0);
  fields.update("full_well_e", camera.sensor.full_well_e, 100.0, 1e6);
  fields.update("read_noise_e", camera.sensor.read_noise_e, 0.0, 1000.0);
  fields.update("black_level", camera.sensor.black_level, 0.0, 255.0);
  fields.update("noise", camera.sensor.noise);
  fields.refuseUnknown();
}

void readCalibration(YamlFields fields, RigErrors& errors) {
  fields.update("between_mm", errors.between_m, 0.0, 10.0, kMilli);
  fields.update("between_deg", errors.between_rad, 0.0, 5.0, kDegree);
  fields.update("to_robot_mm", errors.to_robot_m, 0.0, 100.0, kMilli);
  fields.update("to_robot_deg", errors.to_robot_rad, 0.0, 5.0, kDegree);
  fields.refuseUnknown();
}

/// Reads a section into its options if it is there.
template <class Options>
void readIfThere(YamlFields& fields, const char* name, void (*read)(YamlFields, Options&),
                 Options& options) {
  if (fields.has(name)) {
    read(fields.section(name), options);
  }
}

}  // namespace

Scenario loadScenario(const std::filesystem::path& path) {
  YamlFields fields = YamlFields::open(path);
  Scenario scenario;
  scenario.name = fields.text("name");
  readIfThere(fields, "belt", readBelt, scenario.cell.belt);
  readIfThere(fields, "hook", readHook, scenario.cell.hook);
  readIfThere(fields, "ring", readRing, scenario.cell.ring);
  readMachines(fields, scenario.cell);
  readIfThere(fields, "light", readLight, scenario.cell.scene.light);
  readIfThere(fields, "background", readBackground, scenario.cell.scene);
  readIfThere(fields, "occluder", readOccluder, scenario.cell.scene.occluder);
  readIfThere(fields, "board", readBoard, scenario.cell.scene.board);
  readIfThere(fields, "camera", readCamera, scenario.camera);
  readIfThere(fields, "calibration", readCalibration, scenario.calibration);
  fields.refuseUnknown();
  return scenario;
}

}  // namespace ringhook
