// Ctrl-C on the real program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/scratch_folder.h"
#include "../unit/app/program.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

TEST(ServoProgram, CtrlCStopsTheArmThenSavesAndExitsWithOne) {
  const ScratchFolder scratch;
  test::Program program(scratch.path(), {"servo", "--cycles", "1", "--out", "out"});
  ASSERT_TRUE(program.waitUntilItSays("hook 1, approach"));
  program.signal(SIGINT);
  const test::ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("stopped by the operator"));
  std::ifstream file(scratch.path() / "out" / "summary.json");
  ASSERT_TRUE(file.is_open());
  const nlohmann::json summary = nlohmann::json::parse(file);
  EXPECT_EQ(summary.at("interrupted"), true);
  EXPECT_EQ(summary.at("rings_hung"), 0);
  EXPECT_EQ(summary.at("cycles_asked"), 1);
}

}  // namespace
}  // namespace ringhook
