// `ringhook calibrate stereo --cell` as an integrator runs it in the simulated cell, left once with
// Ctrl-C and taken up again.

#include <gmock/gmock.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/scratch_folder.h"
#include "../unit/app/program.h"
#include "rig/stereo_rig.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using test::Program;
using test::ProgramResult;
using ::testing::HasSubstr;

const std::vector<std::string> kLive = {
    "calibrate", "stereo",
    "--cell",    RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml",
    "--board",   "chessboard:9x6:30mm",
    "--shots",   "shots",
    "--out",     "rig.yaml",
    "--json",    "rig.json"};

TEST(StereoProgram, TakesItsPicturesAndGoesOnAfterCtrlC) {
  const ScratchFolder folder;
  Program begun(folder.path(), kLive);
  ASSERT_TRUE(begun.waitUntilThereIs(folder.path() / "shots/board/right/0003.png"));
  begun.signal(SIGINT);
  const ProgramResult left = begun.wait();
  EXPECT_EQ(left.exit_code, 1);
  EXPECT_THAT(left.err, HasSubstr("the same command goes on from here"));
  EXPECT_FALSE(fs::exists(folder.path() / "rig.yaml"));
  const auto kept = std::distance(fs::directory_iterator(folder.path() / "shots/board/left"), {});
  EXPECT_GE(kept, 2);

  const ProgramResult done = test::runProgram(folder.path(), kLive);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("pairs are there already"));
  const StereoRig rig = loadRig(folder.path() / "rig.yaml");
  EXPECT_NEAR(1e3 * baseline(rig), 400.0, 0.5);  // the cameras stand within 0.3 mm of the drawing
  std::ifstream file(folder.path() / "rig.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_LT(json.at("heldout_vertical_disparity_px"), 0.06);
  EXPECT_GE(json.at("views_used"), 18);
}

TEST(StereoProgram, WantsEitherImagesOrACell) {
  const ScratchFolder folder;
  std::vector<std::string> both = kLive;
  both.insert(both.end(), {"--left", "l*.png", "--right", "r*.png"});
  for (const auto& arguments :
       {both, std::vector<std::string>{"calibrate", "stereo", "--left", "l*.png", "--board",
                                       "chessboard:9x6:30mm", "--out", "rig.yaml"}}) {
    const ProgramResult result = test::runProgram(folder.path(), arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("expected either --left and --right, or --cell"));
  }
}

}  // namespace
}  // namespace ringhook
