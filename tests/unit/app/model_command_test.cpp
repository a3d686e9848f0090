// `ringhook model` as a user runs it.

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "../../support/scratch_folder.h"
#include "program.h"

namespace ringhook {
namespace {

using test::ProgramResult;
using test::runProgram;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::filesystem::path kHook =
    std::filesystem::path(RINGHOOK_SOURCE_DIR) / "datasets/models/hook";

TEST(ModelHook, ItsDefaultsAreTheStoredModelsBitByBit) {
  const ScratchFolder folder;
  const ProgramResult result = runProgram(folder.path(), {"model", "hook", "--out", "hook"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const auto* name : {"hook.cao", "hook.obj", "marker.yaml"}) {
    EXPECT_EQ(textOf(folder.path() / "hook" / name), textOf(kHook / name)) << name;
  }
}

TEST(ModelHook, MeasuresAreInMillimetres) {
  const ScratchFolder folder;
  const ProgramResult result =
      runProgram(folder.path(), {"model", "hook", "--tip-rise-mm", "31", "--out", "hook"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(textOf(folder.path() / "hook/hook.cao"), HasSubstr("0.003000 0.041000 0.031000"));
}

TEST(ModelHook, RefusesWhatIsNoHookAndWritesNothing) {
  const ScratchFolder folder;
  const ProgramResult result =
      runProgram(folder.path(), {"model", "hook", "--arc-radius-mm", "5", "--out", "hook"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("arc radius"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "hook"));
}

TEST(ModelConvert, AMeshInMillimetresBecomesAModelWithItsCounts) {
  const ScratchFolder folder;
  folder.write(
      "box.obj",
      "v 0 0 0\nv 80 0 0\nv 80 60 0\nv 0 60 0\nv 0 0 40\nv 80 0 40\nv 80 60 40\nv 0 60 40\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const ProgramResult result =
      runProgram(folder.path(), {"model", "convert", "box.obj", "--scale", "0.001", "--out",
                                 "box.cao", "--json", "box.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("0.08 x 0.06 x 0.04 m, 12 edges"));
  const auto json = nlohmann::json::parse(textOf(folder.path() / "box.json"));
  EXPECT_EQ(json.at("lines"), 12);
  EXPECT_EQ(json.at("flat_faces"), 6);
  EXPECT_THAT(textOf(folder.path() / "box.cao"),
              AllOf(HasSubstr("V1\n"), HasSubstr("0.080000000 0.060000000 0.040000000")));
}

/// Exit code 2, one sentence, no model written.
void expectRefused(const ScratchFolder& folder, const std::vector<std::string>& more,
                   const std::string& words) {
  std::vector<std::string> arguments = {"model", "convert", "--out", "part.cao"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProgramResult result = runProgram(folder.path(), arguments);
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr(words));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "part.cao"));
}

TEST(ModelConvert, BadInputIsNamedAndNothingWritten) {
  const ScratchFolder folder;
  expectRefused(folder, {"missing.obj"}, "missing.obj");
  expectRefused(folder, {"."}, "cannot read this mesh");
  folder.write("empty.obj", "");
  expectRefused(folder, {"empty.obj"}, "empty.obj: no face found");
  folder.write("part.stl", "solid part\nfacet normal 0 0 1\n");
  expectRefused(folder, {"part.stl"}, "part.stl:1:");
  folder.write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n");
  expectRefused(folder, {"broken.obj"}, "broken.obj:4: point 7");
  folder.write("tall.obj", "v 0 0 0\nv 450 0 0\nv 0 450 0\nf 1 2 3\n");
  expectRefused(folder, {"tall.obj"}, "--scale 0.001");
  expectRefused(folder, {"tall.obj", "--scale", "0.001", "--feature-angle-deg", "0"},
                "--feature-angle-deg");
  expectRefused(folder, {}, "FILE");
}

}  // namespace
}  // namespace ringhook
