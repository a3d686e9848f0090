// The program as an operator or a script meets it: exit codes, one sentence, nothing half-written.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "../../support/scratch_folder.h"
#include "program.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using test::ProgramResult;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const std::string kConfig = RINGHOOK_SOURCE_DIR "/app/config/";

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
}

class Command : public ::testing::Test {
 protected:
  [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
    return test::runProgram(scratch_.path(), arguments);
  }

  /// The default cell with its paths made whole and one of its values replaced.
  [[nodiscard]] std::string cellWith(const std::string& from, const std::string& to) const {
    std::string text = textOf(kConfig + "cell-sim.yaml");
    replace(text, from, to);
    for (const char* local : {"rig: rig-sim.yaml", "scenario: scenarios/"}) {
      if (text.find(local) != std::string::npos) {
        const std::string field = std::string(local).substr(0, std::string(local).find(' ') + 1);
        replace(text, local, field + kConfig + std::string(local).substr(field.size()));
      }
    }
    for (std::size_t at = 0; (at = text.find("../../datasets")) != std::string::npos;) {
      text.replace(at, 5, RINGHOOK_SOURCE_DIR);
    }
    return scratch_.write("cell.yaml", text).string();
  }

  /// Exit code 2, one sentence that names `culprit`, nothing written.
  void expectRefused(const ProgramResult& result, const std::string& culprit) const {
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(culprit));
    EXPECT_THAT(result.err, StartsWith("ringhook: "));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_FALSE(fs::exists(scratch_.path() / "out"));
  }

  /// The same of a command line that is wrong in itself; a second line points to --help.
  void expectWrongUse(const ProgramResult& result, const std::string& culprit) const {
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(culprit));
    EXPECT_THAT(result.err, HasSubstr("Run with --help"));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 2) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_FALSE(fs::exists(scratch_.path() / "out"));
  }

  ScratchFolder scratch_;
};

TEST_F(Command, UnknownOptionIsNamed) {
  expectWrongUse(run({"servo", "--out", "out", "--frobnicate"}), "--frobnicate");
}

TEST_F(Command, UnknownSubcommandIsWrongUse) { expectWrongUse(run({"dance"}), "dance"); }

TEST_F(Command, NoSubcommandIsWrongUse) { expectWrongUse(run({}), "a command is required"); }

TEST_F(Command, NoCyclesAtAllIsWrongUse) {
  expectWrongUse(run({"servo", "--out", "out", "--cycles", "0"}), "--cycles");
}

TEST_F(Command, UnknownTrackerIsWrongUse) {
  expectWrongUse(run({"servo", "--out", "out", "--tracker", "eyes"}), "--tracker");
}

TEST_F(Command, SeedThatIsNoNumberIsWrongUse) {
  expectWrongUse(run({"servo", "--out", "out", "--seed", "lucky"}), "--seed");
}

TEST_F(Command, MissingCellFileIsNamed) {
  expectRefused(run({"servo", "--out", "out", "--cell", "nowhere.yaml"}), "nowhere.yaml");
}

TEST_F(Command, FolderAsCellFileIsNamed) {
  expectRefused(run({"servo", "--out", "out", "--cell", scratch_.path().string()}),
                scratch_.path().string());
}

TEST_F(Command, SpoiltCellIsNamedWithLineAndField) {
  const ProgramResult result =
      run({"servo", "--out", "out", "--cell", cellWith("rate_hz: 50", "rate_hz: fast")});
  expectRefused(result, "cell.yaml");
  EXPECT_THAT(result.err, HasSubstr("line "));
  EXPECT_THAT(result.err, HasSubstr("vision.rate_hz"));
}

TEST_F(Command, MissingRigIsNamed) {
  expectRefused(
      run({"servo", "--out", "out", "--cell", cellWith("rig: rig-sim.yaml", "rig: gone.yaml")}),
      "gone.yaml");
}

TEST_F(Command, RigWithAMatrixOfWrongShapeIsNamedWithItsKey) {
  std::string rig = textOf(kConfig + "rig-sim.yaml");
  replace(rig, "cols: 3", "cols: 2");
  scratch_.write("skew.yaml", rig);
  const ProgramResult result =
      run({"servo", "--out", "out", "--cell", cellWith("rig: rig-sim.yaml", "rig: skew.yaml")});
  expectRefused(result, "skew.yaml");
  EXPECT_THAT(result.err, HasSubstr("K1"));
}

TEST_F(Command, EdgeModelWithoutFacesIsNamed) {
  scratch_.write("empty.cao", "V1\n3\n0 0 0\n1 0 0\n0 1 0\n0\n0\n0\n0\n0\n");
  const std::string cell =
      cellWith("model: ../../datasets/models/hook/hook.cao", "model: empty.cao");
  const ProgramResult result = run({"servo", "--out", "out", "--tracker", "edges", "--cell", cell});
  expectRefused(result, "empty.cao");
  EXPECT_THAT(result.err, HasSubstr("face"));
}

TEST_F(Command, UnknownScenarioIsNamed) {
  expectRefused(run({"servo", "--out", "out", "--scenario", "typhoon"}), "typhoon");
}

TEST_F(Command, FolderThatCannotBeWrittenIsNamed) {
  scratch_.write("occupied", "a file where a folder would have to be\n");
  const ProgramResult result = run({"servo", "--cycles", "1", "--out", "occupied/out"});
  expectRefused(result, "occupied/out");
  EXPECT_EQ(textOf(scratch_.path() / "occupied"), "a file where a folder would have to be\n");
}

TEST_F(Command, VersionIsTheProjectsOwn) {
  const ProgramResult result = run({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, RINGHOOK_PROJECT_VERSION "\n");
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(Command, HelpNamesEveryCommand) {
  const ProgramResult result = run({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* command : {"servo", "calibrate", "evaluate", "simulate"}) {
    EXPECT_THAT(result.out, HasSubstr(command));
  }
}

class CommandHelp : public Command, public ::testing::WithParamInterface<std::string> {};

TEST_P(CommandHelp, ShowsAnExample) {
  std::vector<std::string> arguments;
  std::istringstream words(GetParam());
  for (std::string word; words >> word;) {
    arguments.push_back(word);
  }
  arguments.emplace_back("--help");
  const ProgramResult result = run(arguments);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out, HasSubstr("Example"));
  EXPECT_THAT(result.out, HasSubstr("ringhook " + GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Command, CommandHelp,
                         ::testing::Values("servo", "calibrate stereo", "evaluate sequence",
                                           "simulate"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace ringhook
