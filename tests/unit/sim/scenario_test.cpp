#include "sim/scenario.h"
#include "core/angle.h"

#include <gtest/gtest.h>

#include "../../support/scratch_folder.h"
#include "core/error.h"

namespace ringhook {
namespace {

Scenario loaded(const std::string& text) {
  const ScratchFolder folder;
  return loadScenario(folder.write("scenario.yaml", text));
}

std::string complaint(const std::string& text) {
  try {
    static_cast<void>(loaded(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Scenario, TheEasyOneIsTheDefaultCell) {
  const Scenario easy =
      loadScenario(std::filesystem::path(RINGHOOK_SOURCE_DIR) / "app/config/scenarios/easy.yaml");
  EXPECT_EQ(easy.name, "easy");
  EXPECT_DOUBLE_EQ(easy.cell.belt.speed, 0.05);
  EXPECT_NEAR(easy.cell.hook.swing_about_x, 0.0523599, 1e-6);
  EXPECT_EQ(easy.cell.hook.count, 3);
  EXPECT_DOUBLE_EQ(easy.cell.ring.clearance, 0.013);
}

TEST(Scenario, ConvertsDegreesAndKeepsDefaults) {
  const Scenario s = loaded("name: x\nhook: {swing_about_y_deg: 15}\n");
  EXPECT_NEAR(s.cell.hook.swing_about_y, 0.2617994, 1e-7);
  EXPECT_DOUBLE_EQ(s.cell.belt.speed, CellOptions{}.belt.speed);
}

TEST(Scenario, EveryKeyOfBeltAndHookReachesItsOption) {
  const CellOptions cell = loaded(R"(
name: x
belt: {speed_m_s: 0.11, speed_spread: 0.12, start_s: 1.3, stops: 14, run_s: [1.5, 1.6],
  stand_s: [1.7, 1.8], acceleration_m_s2: 1.9, jerk_m_s3: 2.1, pitch_m: 0.22, ripple: [0.05, 0.01],
  start_y_m: -0.23, entry_y_m: -0.24}
hook: {count: 4, spacing_m: 0.61, swing_about_x_deg: 6.2, swing_about_y_deg: 6.3, swing_least: 0.64,
  length_spread: 0.065, pivot_friction_N_m: 0.066, pivot_damping_N_m_s: 0.067, damping_spread: 0.68}
)")
                               .cell;
  EXPECT_EQ(cell.belt.speed, 0.11);
  EXPECT_EQ(cell.belt.speed_spread, 0.12);
  EXPECT_EQ(cell.belt.start_s, 1.3);
  EXPECT_EQ(cell.belt.stops, 14);
  EXPECT_DOUBLE_EQ(cell.belt.run_s.low + cell.belt.run_s.high, 3.1);
  EXPECT_DOUBLE_EQ(cell.belt.stand_s.low + cell.belt.stand_s.high, 3.5);
  EXPECT_EQ(cell.belt.acceleration, 1.9);
  EXPECT_EQ(cell.belt.jerk, 2.1);
  EXPECT_EQ(cell.belt.pitch, 0.22);
  EXPECT_EQ(cell.belt.ripple, (std::vector<double>{0.05, 0.01}));
  EXPECT_EQ(cell.belt.start_y, -0.23);
  EXPECT_EQ(cell.belt.entry_y, -0.24);
  EXPECT_EQ(cell.hook.count, 4);
  EXPECT_EQ(cell.hook.spacing, 0.61);
  EXPECT_DOUBLE_EQ(cell.hook.swing_about_x, 6.2 * kDegree);
  EXPECT_DOUBLE_EQ(cell.hook.swing_about_y, 6.3 * kDegree);
  EXPECT_EQ(cell.hook.swing_least, 0.64);
  EXPECT_EQ(cell.hook.length_spread, 0.065);
  EXPECT_EQ(cell.hook.pivot_friction, 0.066);
  EXPECT_EQ(cell.hook.pivot_damping, 0.067);
  EXPECT_EQ(cell.hook.damping_spread, 0.68);
}

TEST(Scenario, EveryKeyOfRingArmGripperAndAirReachesItsOption) {
  const CellOptions cell = loaded(R"(
name: x
ring: {count: 7, clearance_m: 0.0071, friction: 0.72}
arm: {zero_error_sigma_deg: 0.073}
gripper: {feeder_clearance_m: 0.74}
air: {density_kg_m3: 0.75, viscosity_Pa_s: 0.76}
)")
                               .cell;
  EXPECT_EQ(cell.ring.count, 7);
  EXPECT_EQ(cell.ring.clearance, 0.0071);
  EXPECT_EQ(cell.ring.friction, 0.72);
  EXPECT_DOUBLE_EQ(cell.arm.zero_error_sigma, 0.073 * kDegree);
  EXPECT_EQ(cell.gripper.feeder_clearance, 0.74);
  EXPECT_EQ(cell.air_density, 0.75);
  EXPECT_EQ(cell.air_viscosity, 0.76);
}

TEST(Scenario, EveryKeyOfTheSceneReachesItsOption) {
  const Scenario s = loaded(R"(
name: x
light: {setup: side, brightness: 0.31, brightness_spread: 0.32, direction_spread_deg: 33,
  shadows: false, shadow_map_px: 341}
background: {wall: textured, clutter: 35, specular: 3.6, seed: 37}
occluder: {count: 38, speed_m_s: 0.39, speed_spread: 0.41, width_m: 0.042, x_m: 0.93, first_s: 4.4,
  interval_s: 4.5}
board: {columns: 6, rows: 7, square_m: 0.048, fMt: [0.1, 0.2, 0.3, 0, 0, 1, 0]}
)");
  const SceneOptions& scene = s.cell.scene;
  EXPECT_EQ(scene.light.setup, LightSetup::side);
  EXPECT_EQ(scene.light.brightness, 0.31);
  EXPECT_EQ(scene.light.brightness_spread, 0.32);
  EXPECT_DOUBLE_EQ(scene.light.direction_spread, 33 * kDegree);
  EXPECT_FALSE(scene.light.shadows);
  EXPECT_EQ(scene.light.shadow_map_px, 341);
  EXPECT_EQ(scene.wall, WallKind::textured);
  EXPECT_EQ(scene.clutter, 35);
  EXPECT_EQ(scene.specular, 3.6);
  EXPECT_EQ(scene.seed, 37U);
  EXPECT_EQ(scene.occluder.count, 38);
  EXPECT_EQ(scene.occluder.speed, 0.39);
  EXPECT_EQ(scene.occluder.speed_spread, 0.41);
  EXPECT_EQ(scene.occluder.width, 0.042);
  EXPECT_EQ(scene.occluder.x, 0.93);
  EXPECT_EQ(scene.occluder.first_s, 4.4);
  EXPECT_EQ(scene.occluder.interval_s, 4.5);
  EXPECT_EQ(scene.board.columns, 6);
  EXPECT_EQ(scene.board.rows, 7);
  EXPECT_EQ(scene.board.square, 0.048);
  EXPECT_TRUE((scene.board.fMt * Eigen::Vector3d(1.0, 0.0, 0.0))
                  .isApprox(Eigen::Vector3d(-0.9, 0.2, 0.3), 1e-12));
}

TEST(Scenario, EveryKeyOfCameraAndCalibrationReachesItsOption) {
  const Scenario s = loaded(R"(
name: x
camera: {rate_hz: 51, highest_rate_hz: 52, transport_delay_ms: 53, exposure_ms: 5.4, gain: 5.5,
  full_well_e: 5600, read_noise_e: 5.7, black_level: 5.8, noise: false}
calibration: {between_mm: 0.81, between_deg: 0.82, to_robot_mm: 0.83, to_robot_deg: 0.84}
)");
  EXPECT_EQ(s.camera.rate_hz, 51.0);
  EXPECT_EQ(s.camera.highest_rate_hz, 52.0);
  EXPECT_DOUBLE_EQ(s.camera.transport_delay_s, 0.053);
  EXPECT_DOUBLE_EQ(s.camera.sensor.exposure_s, 0.0054);
  EXPECT_EQ(s.camera.sensor.gain, 5.5);
  EXPECT_EQ(s.camera.sensor.full_well_e, 5600.0);
  EXPECT_EQ(s.camera.sensor.read_noise_e, 5.7);
  EXPECT_EQ(s.camera.sensor.black_level, 5.8);
  EXPECT_FALSE(s.camera.sensor.noise);
  EXPECT_DOUBLE_EQ(s.calibration.between_m, 0.00081);
  EXPECT_DOUBLE_EQ(s.calibration.between_rad, 0.82 * kDegree);
  EXPECT_DOUBLE_EQ(s.calibration.to_robot_m, 0.00083);
  EXPECT_DOUBLE_EQ(s.calibration.to_robot_rad, 0.84 * kDegree);
}

TEST(Scenario, RefusesFallingRangesGreatRippleAndUnknownChoices) {
  EXPECT_NE(complaint("name: x\nbelt: {run_s: [3, 1]}\n").find("belt.run_s: expected [from, to]"),
            std::string::npos);
  EXPECT_NE(complaint("name: x\nbelt: {stand_s: [3]}\n").find("belt.stand_s"), std::string::npos);
  EXPECT_NE(complaint("name: x\nbelt: {ripple: [0.2, 0.2, 0.2]}\n").find("belt.ripple"),
            std::string::npos);
  EXPECT_NE(complaint("name: x\nlight: {setup: candle}\n").find("one of hall, side, got candle"),
            std::string::npos);
}

TEST(Scenario, NamesLineAndFieldOfAnUnknownKey) {
  const std::string what = complaint("name: x\nbelt:\n  speed_mm_s: 50\n");
  EXPECT_NE(what.find("line 3"), std::string::npos) << what;
  EXPECT_NE(what.find("belt.speed_mm_s"), std::string::npos) << what;
  EXPECT_NE(complaint("name: x\nbelts: {}\n").find("belts"), std::string::npos);
}

TEST(Scenario, RefusesValuesOutOfRangeOrOfTheWrongKind) {
  EXPECT_NE(complaint("name: x\nbelt: {speed_m_s: fast}\n").find("belt.speed_m_s"),
            std::string::npos);
  EXPECT_NE(complaint("name: x\nbelt: {speed_m_s: .nan}\n").find("0 to 1"), std::string::npos);
  EXPECT_NE(complaint("name: x\nhook: {count: 2.5}\n").find("whole"), std::string::npos);
  EXPECT_NE(complaint("name: x\nring: 3\n").find("ring"), std::string::npos);
}

TEST(Scenario, RefusesFilesThatAreNoScenario) {
  EXPECT_THROW(static_cast<void>(loadScenario("/nowhere/x.yaml")), InputError);
  EXPECT_NE(complaint("name: [").find("line"), std::string::npos);
  EXPECT_NE(complaint("belt: {speed_m_s: 0.1}\n").find("name"), std::string::npos);
  EXPECT_NE(complaint("").find("name"), std::string::npos);
}

}  // namespace
}  // namespace ringhook
