// The whole set-up of the simulated cell as an integrator does it, on a terminal: left by pulling
// the plug, taken up again, to the end. Truth: where the simulated cameras really stand.

#include <gmock/gmock.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/scratch_folder.h"
#include "calib/wizard/shot_folder.h"
#include "cycle/cell_config.h"
#include "rig/stereo_rig.h"
#include "sim/nominal_rig.h"
#include "sim/scenario.h"
#include "tests/support/terminal.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using test::Terminal;
using ::testing::AnyOf;

constexpr std::uint64_t kSeed = 3;

StereoRig trueRig() {
  const Scenario easy = loadScenario(RINGHOOK_SOURCE_DIR "/app/config/scenarios/easy.yaml");
  return disturbedRig(nominalRig(), kSeed, easy.calibration);
}

const std::vector<std::string> kWizard = {
    "calibrate", "wizard", "--session",           "session",    "--rigs",
    "rigs",      "--seed", std::to_string(kSeed), "--no-window"};

/// Answers the first two questions and pulls the plug in the middle of the board's pictures.
void beginAndKill(const fs::path& folder) {
  Terminal terminal(folder, kWizard);
  ASSERT_TRUE(terminal.waitFor("Which cell?")) << terminal.said();
  terminal.type("no/such/cell.yaml");
  ASSERT_TRUE(terminal.waitFor("no/such/cell.yaml")) << terminal.said();
  ASSERT_TRUE(terminal.waitFor("Which cell?")) << terminal.said();
  terminal.type("");
  ASSERT_TRUE(terminal.waitFor("Which board")) << terminal.said();
  terminal.type("");
  ASSERT_TRUE(terminal.waitFor("pair 4:")) << terminal.said();
  terminal.signal(SIGKILL);
  EXPECT_EQ(terminal.wait(), -1);
  EXPECT_GE(ShotFolder(folder / "session/board", false).count(), 4U);
}

void expectNearTruth(const StereoRig& rig) {
  const StereoRig truth = trueRig();
  EXPECT_NEAR(baseline(rig) / baseline(truth), 1.0, 5e-4);
  EXPECT_NEAR(rig.left.K(0, 0) / truth.left.K(0, 0), 1.0, 1e-3);
  ASSERT_TRUE(rig.fMc1);
  EXPECT_LT((rig.fMc1->translation() - truth.fMc1->translation()).norm(), 1.5e-3);
  EXPECT_GT(rig.camera_delay_s, 0.0055);  // the place draws it between 6 and 14 ms
  EXPECT_LT(rig.camera_delay_s, 0.0145);
  EXPECT_GT(rig.robot_delay_s, 0.0005);  // and this between 1 and 7 ms
  EXPECT_LT(rig.robot_delay_s, 0.0075);
}

/// The check once more with new pictures; then the cameras from the session's own pictures.
void goThroughAgain(const fs::path& folder) {
  auto again = kWizard;
  again.insert(again.end(), {"--again", "check"});
  Terminal check(folder, again);
  EXPECT_TRUE(check.waitFor("Done before: time")) << check.said();
  EXPECT_TRUE(check.waitFor("pair 1:")) << check.said();
  EXPECT_EQ(check.wait(), 0) << check.said();
  Terminal stored(folder, {"calibrate", "wizard", "--session", "stored", "--images", "session",
                           "--cell", "session/cell.yaml", "--board", "chessboard:9x6:30mm",
                           "--until", "stereo", "--no-window"});
  EXPECT_EQ(stored.wait(), 0) << stored.said();
  const StereoRig first = loadRig(folder / "session/rig-stereo.yaml");
  const StereoRig second = loadRig(folder / "stored/rig-stereo.yaml");
  EXPECT_NEAR(baseline(first), baseline(second), 1e-8);
  EXPECT_FALSE(fs::exists(folder / "stored/rig-robot.yaml"));
}

TEST(WizardProgram, SetsTheSimulatedCellUpThoughItWasKilledOnce) {
  const ScratchFolder folder;
  beginAndKill(folder.path());
  Terminal terminal(folder.path(), kWizard);
  ASSERT_TRUE(terminal.waitFor("Taking up the session")) << terminal.said();
  ASSERT_TRUE(terminal.waitFor("pairs are there already")) << terminal.said();
  ASSERT_EQ(terminal.wait(), 0) << terminal.said();
  const CellConfig cell = loadCellConfig(folder.path() / "session/cell.yaml");
  expectNearTruth(loadRig(cell.rig));
  const auto report = nlohmann::json::parse(std::ifstream(folder.path() / "session/report.json"));
  for (const char* step : {"stereo", "robot"}) {
    EXPECT_THAT(report.at(step).at("verdict").get<std::string>(), AnyOf("good", "usable")) << step;
  }
  EXPECT_TRUE(fs::is_regular_file(folder.path() / "session/live.png"));
  EXPECT_FALSE(fs::is_empty(folder.path() / "rigs"));
  goThroughAgain(folder.path());
}

TEST(WizardProgram, CtrlCAtAQuestionLeavesAtOnceAndNothingBehind) {
  const ScratchFolder folder;
  Terminal terminal(folder.path(), kWizard);
  ASSERT_TRUE(terminal.waitFor("Which cell?")) << terminal.said();
  terminal.signal(SIGINT);
  EXPECT_EQ(terminal.wait(), 1) << terminal.said();
  EXPECT_FALSE(fs::exists(folder.path() / "session"));
}

TEST(WizardProgram, AnotherBoardThanTheSessionsIsAMistake) {
  const ScratchFolder folder;
  fs::create_directories(folder.path() / "session");
  std::ofstream(folder.path() / "session/wizard.yaml")
      << "cell: " << RINGHOOK_SOURCE_DIR << "/app/config/cell-sim.yaml\n"
      << "board: chessboard:9x6:30mm\nseed: " << kSeed << "\n";
  auto arguments = kWizard;
  arguments.insert(arguments.end(), {"--board", "chessboard:8x6:30mm"});
  Terminal terminal(folder.path(), arguments);
  EXPECT_TRUE(terminal.waitFor("was begun with chessboard:9x6:30mm")) << terminal.said();
  EXPECT_EQ(terminal.wait(), 2);
}

}  // namespace
}  // namespace ringhook
