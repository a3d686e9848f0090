#include <gmock/gmock.h>

#include <fstream>

#include "../support/scratch_folder.h"
#include "camera/image_file.h"
#include "evaluate_command.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr auto kRig =
    "%YAML:1.0\n---\nimage_width: 64\nimage_height: 48\n"
    "K1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 60., 0., 32., 0., 60., 24., 0., 0., 1. ]\n"
    "D1: !!opencv-matrix\n   rows: 1\n   cols: 4\n   dt: d\n   data: [ 0., 0., 0., 0. ]\n";
constexpr auto kCube = "V1\n4\n0 0 0\n0.1 0 0\n0.1 0.1 0\n0 0.1 0\n0\n0\n1\n4 0 1 2 3\n0\n0\n";

/// Good input for a run; each test spoils one piece.
class BadInput : public ::testing::Test {
 protected:
  BadInput() {
    write("rig.yaml", kRig);
    write("model.cao", kCube);
    writeGrayImage(folder_ / "left" / "0.png", GrayImage(64, 48, 90));
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  [[nodiscard]] CommandResult run(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "sequence",        "--left",  path("left/*.png"), "--rig", path("rig.yaml"), "--target",
        path("model.cao"), "--start", "0,0,1,0,0,0,1",    "--out", out_.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runEvaluate(arguments);
  }
  /// Exit code 2, one sentence, nothing written.
  void expectRefused(const CommandResult& result) const {
    EXPECT_EQ(result.exit_code, 2) << result.message;
    EXPECT_THAT(result.message, Not(HasSubstr("\n")));
    EXPECT_EQ(filesBelow(out_), 0);
  }
  ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
  fs::path out_ = folder_ / "out";
};

TEST_F(BadInput, MissingRigIsNamed) {
  fs::remove(path("rig.yaml"));
  const auto result = run();
  expectRefused(result);
  EXPECT_THAT(result.message, HasSubstr("rig.yaml"));
}

TEST_F(BadInput, WrongMatrixShapeIsNamed) {
  std::string rig = kRig;
  rig.replace(rig.find("rows: 3"), 7, "rows: 2");
  rig.replace(rig.find(", 0., 0., 1. ]"), 14, " ]");
  write("rig.yaml", rig);
  const auto result = run();
  expectRefused(result);
  EXPECT_THAT(result.message, AllOf(HasSubstr("rig.yaml"), HasSubstr("K1")));
}

TEST_F(BadInput, UnreadableImageIsNamed) {
  write("left/0.png", "no image");
  const auto result = run();
  expectRefused(result);
  EXPECT_THAT(result.message, HasSubstr("left/0.png"));
}

TEST_F(BadInput, ImagesOfAnotherSizeThanTheRigs) {
  writeGrayImage(folder_ / "left" / "0.png", GrayImage(32, 24, 90));
  const auto result = run();
  expectRefused(result);
  EXPECT_THAT(result.message, AllOf(HasSubstr("0.png"), HasSubstr("32x24"), HasSubstr("64x48")));
}

TEST_F(BadInput, AModelWithoutAFaceIsNamed) {
  write("model.cao", "V1\n1\n0 0 0\n0\n0\n0\n0\n0\n");
  const auto result = run();
  expectRefused(result);
  EXPECT_THAT(result.message, HasSubstr("model.cao"));
}

TEST_F(BadInput, UnknownOptionAndMethod) {
  expectRefused(run({"--speed", "3"}));
  expectRefused(run({"--method", "magic"}));
  EXPECT_THAT(run({"--method", "magic"}).message, HasSubstr("marker-joint"));
}

TEST_F(BadInput, ABadStartPoseIsNamed) {
  const auto result =
      runEvaluate({"sequence", "--left", path("left/*.png"), "--rig", path("rig.yaml"), "--target",
                   path("model.cao"), "--start", "0,0,one,0,0,0,1", "--out", out_.string()});
  expectRefused(result);
  EXPECT_THAT(result.message, HasSubstr("--start"));
}

TEST_F(BadInput, NeitherFolderNorImages) {
  expectRefused(runEvaluate({"sequence", "--rig", path("rig.yaml"), "--out", out_.string()}));
  expectRefused(runEvaluate({"sequence", path("nowhere"), "--out", out_.string()}));
}

TEST_F(BadInput, ATargetThatIsNeverFoundFailsTheJob) {
  const auto result = run();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.message, HasSubstr("not found in any frame"));
  EXPECT_TRUE(fs::exists(out_ / "summary.json"));
}

}  // namespace
}  // namespace ringhook
