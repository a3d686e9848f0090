#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <sstream>

#include "../../support/scratch_folder.h"
#include "core/error.h"
#include "rig/stereo_rig.h"
#include "sample_rig.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

std::string readAll(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class RigFile : public testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(path_) << text; }

  /// The file with `from` replaced by `to`.
  void edit(const std::string& from, const std::string& to) const {
    std::string text = readAll(path_);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write(text.replace(at, from.size(), to));
  }

  /// Sentence of the InputError that loading throws.
  [[nodiscard]] std::string refusal() const {
    try {
      (void)loadRig(path_);
    } catch (const InputError& e) {
      return e.what();
    }
    return "loaded";
  }

  ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
  fs::path path_ = folder_ / "rig.yaml";
};

TEST_F(RigFile, KeepsEveryFieldThroughSaveAndLoad) {
  StereoRig rig = test::sampleRig();
  rig.fMc1 = makePoseThetaU({1.7, -0.1, 0.7}, {0.3, -1.2, 0.4});
  rig.robot_delay_s = 0.004;
  rig.camera_delay_s = 0.008;
  rig.rms_px = 0.21;
  rig.heldout_vertical_disparity_px = 0.16;
  rig.joint_zeros_rad << 0.0, 4e-4, -6e-4, 5e-4, -8e-4, 0.0;
  rig.board = "chessboard:9x6:25mm";
  rig.views = 13;
  rig.date = "2026-01-31";
  rig.tool_version = "0.1.0";
  saveRig(path_, rig);
  const StereoRig back = loadRig(path_);
  EXPECT_EQ(back.left.K, rig.left.K);
  EXPECT_EQ(back.right->distortion, rig.right->distortion);
  EXPECT_TRUE(back.c2Mc1.isApprox(rig.c2Mc1, 1e-14));
  EXPECT_TRUE(back.fMc1->isApprox(*rig.fMc1, 1e-14));
  EXPECT_TRUE(back.joint_zeros_rad.isApprox(rig.joint_zeros_rad, 1e-14));
  EXPECT_DOUBLE_EQ(back.robot_delay_s, 0.004);
  EXPECT_DOUBLE_EQ(back.camera_delay_s, 0.008);
  EXPECT_EQ(back.rms_px, 0.21);
  EXPECT_EQ(back.heldout_vertical_disparity_px, 0.16);
  EXPECT_EQ(back.board, "chessboard:9x6:25mm");
  EXPECT_EQ(back.views, 13);
  EXPECT_EQ(back.date, "2026-01-31");
  EXPECT_EQ(back.tool_version, "0.1.0");
  EXPECT_NEAR(baseline(back), 0.4, 1e-4);
}

TEST_F(RigFile, IsReadableByOpenCv) {
  saveRig(path_, test::sampleRig());
  const cv::FileStorage file(path_.string(), cv::FileStorage::READ);
  cv::Mat T;
  file["T"] >> T;
  ASSERT_EQ(T.rows, 3);
  EXPECT_EQ(T.at<double>(0), test::sampleRig().c2Mc1.translation().x());
}

TEST_F(RigFile, KeepsUnknownKeysOfEveryKind) {
  saveRig(path_, test::sampleRig());
  write(readAll(path_) +
        "owner: \"cell 3\"\nlens_mm: 12.5\ngain: !!opencv-matrix\n   rows: 1\n   cols: 2\n"
        "   dt: d\n   data: [ 1., 2. ]\nnested:\n   a:\n      b: 4\n   list: [ 1, 2, 3 ]\n");
  const fs::path copy = folder_ / "copy.yaml";
  saveRig(copy, loadRig(path_));
  const cv::FileStorage file(copy.string(), cv::FileStorage::READ);
  EXPECT_EQ(static_cast<std::string>(file["owner"]), "cell 3");
  EXPECT_EQ(static_cast<double>(file["lens_mm"]), 12.5);
  EXPECT_EQ(file["gain"].mat().at<double>(1), 2.0);
  EXPECT_EQ(static_cast<int>(file["nested"]["a"]["b"]), 4);
  EXPECT_EQ(static_cast<int>(file["nested"]["list"][2]), 3);
  EXPECT_EQ(loadRig(copy).unknown_entries.size(), 4U);
}

TEST_F(RigFile, OfOneCameraHoldsNoRightKeys) {
  StereoRig rig = test::sampleRig();
  rig.right.reset();
  saveRig(path_, rig);
  EXPECT_THAT(readAll(path_), testing::Not(testing::HasSubstr("K2")));
  EXPECT_FALSE(loadRig(path_).right);
}

TEST_F(RigFile, NamesMissingAndIllShapedKeys) {
  using testing::HasSubstr;
  const auto edited = [this](const std::string& from, const std::string& to) {
    saveRig(path_, test::sampleRig());
    edit(from, to);
    return refusal();
  };
  EXPECT_THAT(edited("K1:", "Kx:"), HasSubstr("rig.yaml: key K1 is missing, expected a 3x3"));
  EXPECT_THAT(edited("D2:", "Dx:"), HasSubstr("key D2 is missing"));
  EXPECT_THAT(edited("T: !!opencv-matrix\n   rows: 3\n   cols: 1",
                     "T: !!opencv-matrix\n   rows: 1\n   cols: 1"),
              HasSubstr("key T"));
  EXPECT_THAT(edited("image_width: 512", "image_width: wide"),
              HasSubstr("key image_width must be"));
  EXPECT_THAT(edited("image_width: 512", "image_width: -5"), HasSubstr("image_width"));
  EXPECT_THAT(edited("robot_delay_ms: 0.", "robot_delay_ms: .Nan"), HasSubstr("robot_delay_ms"));
  EXPECT_THAT(edited("data: [ 6.2463999999999999e+02", "data: [ -6.2463999999999999e+02"),
              HasSubstr("positive focal"));
}

TEST_F(RigFile, ThatOpenCvWouldReadForEverIsRefused) {
  write("%YAML:1.0\n-----------\ni\n   d\n");
  EXPECT_THAT(refusal(), testing::HasSubstr("with keys at the top"));
  write("%YAML:1.0\nK1: [ 1, 2\n");
  EXPECT_THAT(refusal(), testing::HasSubstr("is not YAML"));
}

TEST_F(RigFile, HoldsJointZerosOnlyIfThereAreAny) {
  StereoRig rig = test::sampleRig();
  saveRig(path_, rig);
  EXPECT_THAT(readAll(path_), testing::Not(testing::HasSubstr("joint_zeros_deg")));
  rig.joint_zeros_rad.setConstant(0.01);
  saveRig(path_, rig);
  const std::string text = readAll(path_);
  EXPECT_THAT(text, testing::HasSubstr("joint_zeros_deg"));
  edit("joint_zeros_deg: !!opencv-matrix\n   rows: 6",
       "joint_zeros_deg: !!opencv-matrix\n   rows: 5");
  EXPECT_THAT(refusal(), testing::HasSubstr("joint_zeros_deg"));
  write(text);
  edit("joint_zeros_deg: !!opencv-matrix\n   rows: 6\n   cols: 1\n   dt: d\n   data: [ ",
       "joint_zeros_deg: !!opencv-matrix\n   rows: 6\n   cols: 1\n   dt: d\n   data: [ 9");
  EXPECT_THAT(refusal(), testing::HasSubstr("six angles below 5 degrees"));
  rig.joint_zeros_rad[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(checkRig(rig, "rig.yaml"), InputError);
}

TEST_F(RigFile, RefusesWhatIsNoRig) {
  for (const char* text :
       {"", "hello", "{\"K1\": 3}", "<?xml version=\"1.0\"?>", "%YAML:1.0\n---\n",
        "%YAML:1.0\n---\nK1: [ 1, 2\n", "%YAML:1.0\n---\n- 1\n- 2\n"}) {
    write(text);
    EXPECT_THAT(refusal(), testing::HasSubstr("rig.yaml")) << text;
  }
  fs::remove(path_);
  EXPECT_THAT(refusal(), testing::HasSubstr("no such file"));
}

TEST_F(RigFile, RefusesMirrorsAndBadNumbersBeforeWriting) {
  StereoRig rig = test::sampleRig();
  rig.c2Mc1.linear().col(0) *= -1.0;
  EXPECT_THROW(saveRig(path_, rig), InputError);
  rig = test::sampleRig();
  rig.left.distortion = Eigen::VectorXd::Zero(3);
  EXPECT_THROW(saveRig(path_, rig), InputError);
  rig = test::sampleRig();
  rig.c2Mc1.translation().setZero();
  EXPECT_THROW(saveRig(path_, rig), InputError);
  EXPECT_FALSE(fs::exists(path_));
}

}  // namespace
}  // namespace ringhook
