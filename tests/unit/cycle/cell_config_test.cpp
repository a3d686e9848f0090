#include "cycle/cell_config.h"
#include "core/angle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "../../support/scratch_folder.h"
#include "core/error.h"
#include "default_cell.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string loadError(const fs::path& file) {
  return messageOf<InputError>([&] { (void)loadCellConfig(file); });
}

/// `text` with the line that starts with `key` (after blanks) replaced; empty `line` removes it.
/// Returns the number of that line, from 1.
int replaceLine(std::string& text, const std::string& key, const std::string& line) {
  const std::size_t at = text.find(key);
  if (at == std::string::npos) {
    ADD_FAILURE() << "the default cell has no " << key;
    return 0;
  }
  const std::size_t start = text.rfind('\n', at) + 1;
  const std::size_t end = text.find('\n', at) + 1;
  text.replace(start, end - start, line.empty() ? "" : line + "\n");
  return 1 +
         static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(start), '\n'));
}

TEST(CellConfig, DefaultCellSaysWhatItsFileSays) {
  const CellConfig cell = test::defaultCell();
  const fs::path folder = test::defaultCellFile().parent_path();
  EXPECT_EQ(cell.name, "default simulated cell");
  EXPECT_EQ(cell.file, test::defaultCellFile());
  EXPECT_EQ(cell.rig, folder / "rig-sim.yaml");
  EXPECT_EQ(cell.devices.scenario, folder / "scenarios/easy.yaml");
  EXPECT_EQ(cell.hook.plate, fs::path(RINGHOOK_SOURCE_DIR "/datasets/models/hook/marker.yaml"));
  EXPECT_EQ(cell.hook.model, fs::path(RINGHOOK_SOURCE_DIR "/datasets/models/hook/hook.cao"));
  EXPECT_EQ(cell.hook.pivot_o, Eigen::Vector3d(0.0, -0.0263, 0.450));
  EXPECT_DOUBLE_EQ(cell.hook.pendulum_length_m, 0.356);
  EXPECT_DOUBLE_EQ(cell.hook.swing_max_rad, 5.0 * kDegree);
  EXPECT_EQ(cell.belt.pivot_start_f, Eigen::Vector3d(0.42, 0.0, 1.05));
  EXPECT_EQ(cell.belt.direction_f, Eigen::Vector3d::UnitY());
  EXPECT_DOUBLE_EQ(cell.belt.search_from_m, -0.44);
  EXPECT_DOUBLE_EQ(cell.belt.search_to_m, -0.34);
  EXPECT_DOUBLE_EQ(cell.belt.pick_from_m, -0.33);
  EXPECT_DOUBLE_EQ(cell.belt.pick_to_m, 0.30);
}

TEST(CellConfig, MillimetresMillisecondsAndDegreesBecomeSi) {
  const CellConfig cell = test::defaultCell();
  EXPECT_NEAR(cell.arm.load_rad[0], -81.3 * kDegree, 1e-15);
  EXPECT_NEAR(cell.arm.standby_rad[5], 4.0 * kDegree, 1e-15);
  EXPECT_DOUBLE_EQ(cell.task.hover_m, 0.045);
  EXPECT_DOUBLE_EQ(cell.task.align_tolerance_m, 0.003);
  EXPECT_DOUBLE_EQ(cell.task.abort_tolerance_m, 0.010);
  EXPECT_DOUBLE_EQ(cell.vision.stale_after_s, 0.150);
  EXPECT_DOUBLE_EQ(cell.vision.transport_delay_s, 0.008);
  EXPECT_EQ(cell.vision.lost_after_frames, 10);
}

TEST(CellConfig, QuaternionIsReadWithItsRealPartLast) {
  // A quarter turn about -y of the flange takes x_r to z_e.
  const Pose eMr = test::defaultCell().arm.eMr;
  EXPECT_TRUE((eMr.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE(eMr.translation().isApprox(Eigen::Vector3d(0.0, 0.0, 0.1427), 1e-12));
}

TEST(CellConfig, BeltDirectionOfAnyLengthBecomesAUnitVector) {
  const ScratchFolder scratch;
  std::string text = test::defaultCellText();
  replaceLine(text, "direction_f:", "  direction_f: [0, -3, 4]");
  const CellConfig cell = loadCellConfig(scratch.write("cell.yaml", text));
  EXPECT_TRUE(cell.belt.direction_f.isApprox(Eigen::Vector3d(0.0, -0.6, 0.8), 1e-15));
}

/// One line of the default cell spoilt, and the field that the sentence must name.
struct Spoilt {
  std::string name;   ///< of the test
  std::string key;    ///< start of the line that is replaced
  std::string line;   ///< in its place
  std::string field;  ///< as the sentence names it
};
void PrintTo(const Spoilt& spoilt, std::ostream* out) { *out << spoilt.line; }

class SpoiltCell : public ::testing::TestWithParam<Spoilt> {};

TEST_P(SpoiltCell, IsRefusedNamingFileLineAndField) {
  const Spoilt& spoilt = GetParam();
  const ScratchFolder scratch;
  std::string text = test::defaultCellText();
  const int line = replaceLine(text, spoilt.key, spoilt.line);
  const fs::path file = scratch.write("cell.yaml", text);
  const std::string message = loadError(file);
  EXPECT_THAT(message,
              AllOf(HasSubstr(file.string()), HasSubstr(spoilt.field), Not(HasSubstr("\n"))));
  EXPECT_THAT(message, HasSubstr("line " + std::to_string(line) + ":"));
}

INSTANTIATE_TEST_SUITE_P(
    WrongType, SpoiltCell,
    ::testing::Values(
        Spoilt{"TextForNumber", "pendulum_length_m:", "  pendulum_length_m: long",
               "field hook.pendulum_length_m"},
        Spoilt{"NotANumber", "gain_per_s:", "  gain_per_s: .nan", "field task.gain_per_s"},
        Spoilt{"Infinite", "search_from_m:", "  search_from_m: -.inf", "field belt.search_from_m"},
        Spoilt{"ListForNumber", "rate_hz:", "  rate_hz: [50]", "field vision.rate_hz"},
        Spoilt{"FractionForCount", "lost_after_frames:", "  lost_after_frames: 2.5",
               "field vision.lost_after_frames"},
        Spoilt{"NumberForList", "direction_f:", "  direction_f: 1", "field belt.direction_f"},
        Spoilt{"TextInList", "tip_o_m:", "  tip_o_m: [0.0, a, 0.025]", "field task.tip_o_m"},
        Spoilt{"ListForPath", "rig:", "rig: [a, b]", "field rig"},
        Spoilt{"EmptyName", "name:", "name: \"\"", "field name"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    WrongLength, SpoiltCell,
    ::testing::Values(
        Spoilt{"TwoOfThree", "pivot_o_m:", "  pivot_o_m: [0.0, 0.45]", "field hook.pivot_o_m"},
        Spoilt{"ThreeOfFour", "ring_e_quaternion_xyzw:", "  ring_e_quaternion_xyzw: [0, 0, 1]",
               "field arm.ring_e_quaternion_xyzw"},
        Spoilt{"SevenOfSix", "load_deg:", "  load_deg: [0, 0, 0, 0, 0, 0, 0]",
               "field arm.load_deg"},
        Spoilt{"NoneOfSix", "standby_deg:", "  standby_deg: []", "field arm.standby_deg"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    OutOfRange, SpoiltCell,
    ::testing::Values(
        Spoilt{"NoLength", "pendulum_length_m:", "  pendulum_length_m: 0",
               "field hook.pendulum_length_m"},
        Spoilt{"TooFast", "speed_fraction:", "  speed_fraction: 1.5", "field arm.speed_fraction"},
        Spoilt{"NegativeTime", "gripper_time_s:", "  gripper_time_s: -0.1",
               "field arm.gripper_time_s"},
        Spoilt{"BackwardsSearch", "search_to_m:", "  search_to_m: -0.5", "field belt.search_to_m"},
        Spoilt{"BackwardsPick", "pick_to_m:", "  pick_to_m: -0.4", "field belt.pick_to_m"},
        Spoilt{"NoFrames", "lost_after_frames:", "  lost_after_frames: 0",
               "field vision.lost_after_frames"},
        Spoilt{"NoHover", "hover_mm:", "  hover_mm: 0", "field task.hover_mm"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    UnknownField, SpoiltCell,
    ::testing::Values(Spoilt{"AtTheTop", "name:", "colour: red\nname: cell",
                             "unknown field colour"},
                      Spoilt{"InASection", "delay_ms:", "  dely_ms: 1\n  delay_ms: 0",
                             "unknown field arm.dely_ms"},
                      Spoilt{"InDevices", "kind:", "  port: 11002\n  kind: simulated",
                             "unknown field devices.port"}),
    [](const auto& test) { return test.param.name; });

class MissingField : public ::testing::TestWithParam<std::string> {};

TEST_P(MissingField, IsNamedWithItsSection) {
  const std::string field = GetParam();
  const std::size_t dot = field.find('.');
  const std::string key = dot == std::string::npos ? field : field.substr(dot + 1);
  const ScratchFolder scratch;
  std::string text = test::defaultCellText();
  const int line = replaceLine(text, key + ":", "");
  const fs::path file = scratch.write("cell.yaml", text);
  const std::string message = loadError(file);
  EXPECT_THAT(message, AllOf(HasSubstr(file.string()), HasSubstr("line "),
                             HasSubstr("field " + field + " is missing")))
      << "removed line " << line;
}

INSTANTIATE_TEST_SUITE_P(CellConfig, MissingField,
                         ::testing::Values("name", "rig", "devices.kind", "devices.scenario",
                                           "hook.plate", "hook.pivot_o_m", "belt.pivot_start_f_m",
                                           "belt.pick_to_m", "arm.ring_e_m", "arm.standby_deg",
                                           "task.gain_per_s", "task.watch_s",
                                           "vision.stale_after_ms"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

TEST(CellConfig, SectionThatIsNoMappingIsRefused) {
  const ScratchFolder scratch;
  const std::string text = test::defaultCellText();
  const fs::path file = scratch.write("cell.yaml", text.substr(0, text.find("arm:")) + "arm: 6\n");
  EXPECT_THAT(loadError(file), AllOf(HasSubstr(file.string()), HasSubstr("line 20: field arm")));
}

TEST(CellConfig, DevicesOfAnUnknownKindAreRefused) {
  const ScratchFolder scratch;
  std::string text = test::defaultCellText();
  replaceLine(text, "kind:", "  kind: hydraulic");
  const fs::path file = scratch.write("cell.yaml", text);
  EXPECT_THAT(loadError(file),
              AllOf(HasSubstr(file.string()), HasSubstr("devices.kind"),
                    HasSubstr("expected one of simulated, network"), HasSubstr("hydraulic")));
}

TEST(CellConfig, DevicesOnANetworkAreWhatTheirFileSays) {
  const CellConfig cell = loadCellConfig(RINGHOOK_SOURCE_DIR "/app/config/cell-network.yaml");
  EXPECT_EQ(cell.devices.kind, DeviceKind::kNetwork);
  EXPECT_EQ(cell.devices.cameras.left, "127.0.0.1");
  EXPECT_EQ(cell.devices.cameras.right, "127.0.0.2");
  EXPECT_TRUE(cell.devices.cameras.host_clock);
  EXPECT_EQ(cell.devices.cameras.trigger, "free-run");
  EXPECT_DOUBLE_EQ(cell.devices.cameras.exposure_s, 0.0005);
  EXPECT_EQ(cell.devices.cameras.packet_bytes, 8000);
  EXPECT_EQ(cell.devices.arm.address, "127.0.0.1");
  EXPECT_EQ(cell.devices.arm.motion_port, 11000);
  EXPECT_EQ(cell.devices.arm.gripper_module, 2);
  EXPECT_TRUE(cell.devices.arm.gripper_closes_on);
  EXPECT_EQ(cell.vision.window_lag_frames, 3);
}

TEST(CellConfig, BadDevicesOnANetworkAreNamed) {
  const std::string good = textOf(RINGHOOK_SOURCE_DIR "/app/config/cell-network.yaml");
  const ScratchFolder scratch;
  const auto refusal = [&](const std::string& key, const std::string& line) {
    std::string text = good;
    replaceLine(text, key, line);
    return loadError(scratch.write("cell.yaml", text));
  };
  EXPECT_THAT(refusal("right:", "    right: 127.0.0.1"), HasSubstr("devices.cameras.right"));
  EXPECT_THAT(refusal("clock:", "    clock: sundial"), HasSubstr("expected one of own, host"));
  EXPECT_THAT(refusal("exposure_us:", "    exposure_us: 0"), HasSubstr("exposure_us"));
  EXPECT_THAT(refusal("gripper_closes:", "    gripper_closes: maybe"),
              HasSubstr("expected one of off, on"));
  EXPECT_THAT(refusal("address:", ""), HasSubstr("field devices.arm.address is missing"));
  EXPECT_THAT(refusal("gripper_pin:", "    gripper_pin: 0\n    motion_port: 70000"),
              HasSubstr("devices.arm.motion_port"));
}

TEST(CellConfig, WhatIsNoYamlIsRefusedWithItsLine) {
  const ScratchFolder scratch;
  const fs::path file = scratch.write("cell.yaml", "name: cell\nrig: [unclosed\nhook: }\n");
  EXPECT_THAT(loadError(file),
              AllOf(HasSubstr(file.string()), HasSubstr("line "), HasSubstr("not valid YAML")));
}

TEST(CellConfig, WhatIsNoMappingIsRefused) {
  const ScratchFolder scratch;
  for (const char* text : {"", "- a\n- b\n", "just words\n"}) {
    const fs::path file = scratch.write("cell.yaml", text);
    EXPECT_THAT(loadError(file), AllOf(HasSubstr(file.string()), HasSubstr("expected a mapping")));
  }
}

TEST(CellConfig, MissingFileAndFolderAreRefusedByName) {
  const ScratchFolder scratch;
  EXPECT_THAT(loadError(scratch.path() / "nowhere.yaml"), HasSubstr("nowhere.yaml"));
  EXPECT_THAT(loadError(scratch.path()), HasSubstr(scratch.path().string()));
}

}  // namespace
}  // namespace ringhook
