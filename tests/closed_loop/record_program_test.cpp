// `ringhook record` as a user runs it, and what may end it.

#include <gmock/gmock.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/scratch_folder.h"
#include "../unit/app/program.h"
#include "camera/sequence.h"
#include "tests/support/tiny_disk.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using test::Program;
using test::ProgramResult;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::vector<std::string> kSmall = {
    "record", "--left-window", "300,800,200,160", "--right-window", "320,810,200,160",
    "--out",  "clip"};

std::vector<std::string> small(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = kSmall;
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(RecordProgram, StoresWhatItWasAskedFor) {
  const ScratchFolder folder;
  ProgramResult result = test::runProgram(
      folder.path(),
      small({"--frames", "5", "--json", "clip.json", "--licence", "CC0", "--name", "five"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Sequence sequence = openSequence(folder.path() / "clip");
  EXPECT_EQ(sequence.frames.size(), 5U);
  EXPECT_EQ(sequence.name, "five");
  EXPECT_EQ(sequence.licence, "CC0");
  std::ifstream file(folder.path() / "clip.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json.at("frames"), 5);
  EXPECT_EQ(json.at("interrupted"), false);
  result = test::runProgram(folder.path(), small({"--frames", "3"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--overwrite"));
  result = test::runProgram(folder.path(), small({"--frames", "3", "--overwrite"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(openSequence(folder.path() / "clip").frames.size(), 3U);
}

TEST(RecordProgram, CtrlCKeepsTheFramesAndExitsWithOne) {
  const ScratchFolder folder;
  Program program(folder.path(), small({"--frames", "400", "--seconds", "40", "--json", "c.json"}));
  ASSERT_TRUE(program.waitUntilItSays("recording:"));
  program.signal(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 1);
  const auto frames = openSequence(folder.path() / "clip").frames.size();
  EXPECT_GT(frames, 0U);
  EXPECT_LT(frames, 400U);
  EXPECT_THAT(result.err, HasSubstr("stopped by the operator: " + std::to_string(frames) +
                                    " frames kept in clip"));
  std::ifstream file(folder.path() / "c.json");
  EXPECT_EQ(nlohmann::json::parse(file).at("interrupted"), true);
}

TEST(RecordProgram, CtrlCBeforeTheFirstFrameNamesNoFolder) {
  const ScratchFolder folder;
  Program program(folder.path(),
                  {"record", "--follow", "marker", "--out", "clip", "--json", "c.json"});
  // From then on it hears the signal.
  ASSERT_TRUE(program.waitUntilThereIs(folder.path() / ".c.partial.json"));
  program.signal(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("stopped by the operator: no frame was stored"));
  EXPECT_FALSE(fs::exists(folder.path() / "clip"));
}

TEST(RecordProgram, KilledHalfwayItLeavesASequence) {
  const ScratchFolder folder;
  Program program(folder.path(), small({"--frames", "400", "--seconds", "40"}));
  ASSERT_TRUE(program.waitUntilItSays("recording:"));
  program.signal(SIGKILL);
  EXPECT_EQ(program.wait().exit_code, -1);
  EXPECT_GT(openSequence(folder.path() / "clip").frames.size(), 0U);
}

TEST(RecordProgram, AFullDiskIsOneSentenceAndKeepsTheWholeFrames) {
  const ScratchFolder folder;
  const auto result = test::runOnTinyDisk(folder.path(), 48'000'000, [&] {
    Program program(folder.path(), small({"--frames", "600", "--seconds", "12"}));
    ASSERT_TRUE(program.waitUntilItSays("recording:"));
    // Somebody else fills the disk meanwhile.
    std::ofstream filler(folder.path() / "filler");
    const std::string block(100'000, 'x');
    while (filler << block << std::flush) {
    }
    const ProgramResult ended = program.wait();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("writing clip/"), HasSubstr("whole frames are kept")));
    const auto frames = openSequence(folder.path() / "clip").frames.size();
    EXPECT_THAT(ended.err, HasSubstr("; " + std::to_string(frames) + " whole frames"));
  });
  if (!result.possible) {
    GTEST_SKIP() << "no disk of its own to be had here";
  }
  EXPECT_TRUE(result.passed);
}

TEST(RecordProgram, TooSmallADiskIsSaidAhead) {
  const ScratchFolder folder;
  const auto result = test::runOnTinyDisk(folder.path(), 2'000'000, [&] {
    const ProgramResult ended =
        test::runProgram(folder.path(), small({"--frames", "600", "--seconds", "12"}));
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("would take about 32 MB"), HasSubstr("are free")));
    EXPECT_FALSE(fs::exists(folder.path() / "clip"));
  });
  if (!result.possible) {
    GTEST_SKIP() << "no disk of its own to be had here";
  }
  EXPECT_TRUE(result.passed);
}

TEST(RecordProgram, WrongUseIsNamed) {
  const ScratchFolder folder;
  const auto refused = [&](std::vector<std::string> arguments, const std::string& words) {
    arguments.insert(arguments.begin(), "record");
    const ProgramResult result = test::runProgram(folder.path(), arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(words));
    EXPECT_FALSE(fs::exists(folder.path() / "x"));
  };
  refused({}, "--out");
  refused({"--out", "x", "--left-window", "0,0,10,10"}, "together");
  refused({"--out", "x", "--left-window", "0,0,10", "--right-window", "0,0,10,10"},
          "--left-window");
  refused({"--out", "x", "--follow", "luck"}, "--follow");
  refused(
      {"--out", "x", "--follow", "edges", "--left-window", "0,0,9,9", "--right-window", "0,0,9,9"},
      "either --follow or windows");
  refused({"--out", "x", "--cell", "missing.yaml"}, "missing.yaml");
  folder.write("empty.yaml", "");
  refused({"--out", "x", "--cell", "empty.yaml"}, "empty.yaml");
  refused({"--out", "x", "--scenario", "nowhere"}, "nowhere");
  refused({"--out", "x", "--json", "./x/counts.json"}, "outside of the sequence folder x");
}

}  // namespace
}  // namespace ringhook
