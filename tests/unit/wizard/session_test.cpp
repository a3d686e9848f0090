#include "calib/wizard/session.h"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "../../support/scratch_folder.h"
#include "core/error.h"
#include "sim/nominal_rig.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

TEST(WizardSession, KeepsWhatWasAnswered) {
  const ScratchFolder folder;
  const Session session(folder.path() / "s");
  EXPECT_FALSE(session.answers());
  session.keep({"/a cell/with: \"odd\" name.yaml", "/images", "charuco:8x6:30mm:22mm", 7});
  const auto answers = session.answers();
  ASSERT_TRUE(answers);
  EXPECT_EQ(answers->cell, "/a cell/with: \"odd\" name.yaml");
  EXPECT_EQ(answers->images, "/images");
  EXPECT_EQ(answers->board, "charuco:8x6:30mm:22mm");
  EXPECT_EQ(answers->seed, 7U);
}

TEST(WizardSession, RefusesASessionFileThatIsNone) {
  const ScratchFolder folder;
  std::ofstream(folder.path() / "wizard.yaml") << "cell: x.yaml\n";
  try {
    (void)Session(folder.path()).answers();
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("board"));
  }
}

TEST(WizardSession, ForgetsAStepWithAllThatStandsOnIt) {
  const ScratchFolder folder;
  const Session session(folder.path());
  for (const char* step : {"stereo", "robot", "time"}) {
    session.keepRig(step, nominalRig());
  }
  session.forgetFrom("robot");
  EXPECT_TRUE(session.rig("stereo"));
  EXPECT_FALSE(session.rig("robot"));
  EXPECT_FALSE(session.rig("time"));
}

TEST(WizardSession, ReportsStepByStep) {
  const ScratchFolder folder;
  const Session session(folder.path());
  session.report("stereo", R"({"rms_px": 0.1})");
  session.report("robot", R"({"heldout_mm": 0.2})");
  session.report("stereo", R"({"rms_px": 0.3})");
  const auto json = nlohmann::json::parse(std::ifstream(folder.path() / "report.json"));
  EXPECT_EQ(json.at("stereo").at("rms_px"), 0.3);
  EXPECT_EQ(json.at("robot").at("heldout_mm"), 0.2);
}

}  // namespace
}  // namespace ringhook
