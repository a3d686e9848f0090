// `ringhook calibrate time` as a stranger meets it: one sentence for each thing that cannot be, and
// a wiggle that was kept tells the same delay again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "../../support/scratch_folder.h"
#include "../app/program.h"
#include "rig/stereo_rig.h"

namespace ringhook {
namespace {

using test::ProgramResult;
using ::testing::HasSubstr;

class TimeCommand : public ::testing::Test {
 protected:
  [[nodiscard]] ProgramResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"calibrate", "time"});
    return test::runProgram(scratch_.path(), arguments);
  }
  ScratchFolder scratch_;
};

TEST_F(TimeCommand, RefusesWhatCannotBeWithOneSentenceEach) {
  (void)scratch_.write("full/something.txt", "x");
  (void)scratch_.write("empty.yaml", "");
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{"--cell", "nowhere.yaml"}, "nowhere.yaml"},
      {{"--cell", "empty.yaml"}, "empty.yaml"},
      {{"--sequence", "nowhere"}, "--sequence nowhere: expected a sequence folder"},
      {{"--sequence", RINGHOOK_SOURCE_DIR "/datasets/visp-castle"}, "--target is missing"},
      {{"--sequence", RINGHOOK_SOURCE_DIR "/datasets/visp-castle", "--target",
        RINGHOOK_SOURCE_DIR "/datasets/models/gripper/marker.yaml"},
       "robot.csv"},
      {{"--keep", "full"}, "--keep full: expected a new or empty folder"},
      {{"--target", "nowhere.yaml"}, "nowhere.yaml"},
      {{"--rig", "nowhere.yaml"}, "nowhere.yaml"},
      {{"--seconds", "1"}, "--seconds"},
  };
  for (const auto& [arguments, expected] : cases) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments[0];
    EXPECT_THAT(result.err, HasSubstr(expected));
    EXPECT_EQ(result.out, "");
  }
}

TEST_F(TimeCommand, ARecordingWithoutThePlateFailsAndWritesNothing) {
  const ProgramResult result =
      run({"--sequence", RINGHOOK_SOURCE_DIR "/datasets/clips/swing-marker", "--target",
           RINGHOOK_SOURCE_DIR "/datasets/models/gripper/marker.yaml", "--out", "rig.yaml"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("too few pictures of the plate"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "rig.yaml"));
}

TEST_F(TimeCommand, AKeptWiggleTellsTheSameDelayAgain) {
  const ProgramResult live = run({"--seconds", "3", "--keep", "kept", "--json", "live.json"});
  ASSERT_EQ(live.exit_code, 0) << live.err;
  const ProgramResult again =
      run({"--sequence", "kept", "--json", "again.json", "--out", "rig.yaml"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const auto one = nlohmann::json::parse(textOf(scratch_.path() / "live.json"));
  const auto two = nlohmann::json::parse(textOf(scratch_.path() / "again.json"));
  EXPECT_NEAR(one.at("robot_delay_ms").get<double>(), two.at("robot_delay_ms").get<double>(), 1e-3);
  EXPECT_EQ(one.at("verdict"), "ok");
  EXPECT_TRUE(one.contains("camera_delay_ms"));
  EXPECT_FALSE(two.contains("camera_delay_ms"));
  const StereoRig told = loadRig(scratch_.path() / "kept/rig.yaml");
  const StereoRig rig = loadRig(scratch_.path() / "rig.yaml");
  EXPECT_NEAR(1e3 * rig.robot_delay_s, two.at("robot_delay_ms").get<double>(), 1e-9);
  EXPECT_EQ(rig.camera_delay_s, told.camera_delay_s);
}

TEST_F(TimeCommand, CtrlCStopsTheArmAndWritesNothing) {
  test::Program program(scratch_.path(), {"calibrate", "time", "--out", "rig.yaml"});
  ASSERT_TRUE(program.waitUntilItSays("10 %"));
  program.signal(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("the arm stands still"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "rig.yaml"));
}

}  // namespace
}  // namespace ringhook
