// Two programs and the wires between them, in a network of their own: `ringhook simulate --cell`
// serves cameras and controller, `ringhook servo` runs on them in real time. How fast and how well
// depends on the host, so only order and outcome are looked at here.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "../support/own_network.h"
#include "../support/scratch_folder.h"
#include "../unit/app/program.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

constexpr const char* kCell = RINGHOOK_SOURCE_DIR "/app/config/cell-network.yaml";

nlohmann::json jsonOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  EXPECT_TRUE(stream.is_open()) << file;
  return nlohmann::json::parse(stream);
}

class LivePrograms : public ::testing::Test {
 protected:
  void SetUp() override { serve({"--truth", "truth"}, "the belt starts when"); }

  void serve(const std::vector<std::string>& more, const std::string& says) {
    if (!test::ownNetwork().empty()) {
      GTEST_SKIP() << test::ownNetwork();
    }
    std::vector<std::string> arguments = {"simulate", "--cell", kCell, "--json", "cell.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    cell_ = std::make_unique<test::Program>(scratch_.path(), arguments);
    ASSERT_TRUE(cell_->waitUntilItSays(says));
  }

  ScratchFolder scratch_;
  std::unique_ptr<test::Program> cell_;
};

TEST_F(LivePrograms, CtrlCStopsTheArmOverTheWireThenSaves) {
  test::Program servo(scratch_.path(), {"servo", "--cell", kCell, "--cycles", "1", "--out", "out"});
  ASSERT_TRUE(servo.waitUntilItSays("hook 1, ")) << servo.saidSoFar();
  servo.signal(SIGINT);
  const test::ProgramResult stopped = servo.wait();
  EXPECT_EQ(stopped.exit_code, 1) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("stopped by the operator"));
  const nlohmann::json summary = jsonOf(scratch_.path() / "out" / "summary.json");
  EXPECT_EQ(summary.at("interrupted"), true);
  EXPECT_TRUE(summary.at("rings_hung").is_null());

  ASSERT_TRUE(cell_->waitUntilItSays("motion: client gone"));
  cell_->signal(SIGINT);
  const test::ProgramResult served = cell_->wait();
  EXPECT_EQ(served.exit_code, 0) << served.err;
  EXPECT_THAT(served.out, HasSubstr("0 rings hang"));
  EXPECT_GT(jsonOf(scratch_.path() / "cell.json").at("received").at("VELOCITY_CMD"), 0);
  EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "truth" / "hooks.csv"));
}

/// The same without hooks and motion.
class ParkedPrograms : public LivePrograms {
 protected:
  void SetUp() override { serve({"--belt-parked"}, "the belt is parked"); }
};

TEST_F(ParkedPrograms, CtrlCEndsTheWigglingOfARealArmAndWritesNothing) {
  test::Program time(scratch_.path(), {"calibrate", "time", "--cell", kCell, "--yes", "--out",
                                       "rig.yaml", "--json", "time.json"});
  ASSERT_TRUE(time.waitUntilItSays("watching the arm: 20 %")) << time.saidSoFar();
  time.signal(SIGINT);
  const test::ProgramResult stopped = time.wait();
  EXPECT_EQ(stopped.exit_code, 1) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("stopped by the operator"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "rig.yaml"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "time.json"));
  ASSERT_TRUE(cell_->waitUntilItSays("motion: client gone"));
  cell_->signal(SIGINT);
  EXPECT_EQ(cell_->wait().exit_code, 0);
  EXPECT_GT(jsonOf(scratch_.path() / "cell.json").at("received").at("VELOCITY_CMD"), 0);
}

TEST_F(LivePrograms, ACellThatGoesAwayStopsTheRunWithItsReason) {
  test::Program servo(scratch_.path(), {"servo", "--cell", kCell, "--cycles", "1", "--out", "out"});
  ASSERT_TRUE(servo.waitUntilItSays("hook 1, ")) << servo.saidSoFar();
  cell_->signal(SIGKILL);
  const test::ProgramResult ended = servo.wait();
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("ringhook: "));
}

}  // namespace
}  // namespace ringhook
