#include "camera/sequence.h"

#include <gmock/gmock.h>

#include <numbers>

#include "../../support/scratch_folder.h"
#include "camera/image_file.h"
#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A folder with two tiny images whose tables a test may spoil.
class SequenceFolder : public ::testing::Test {
 protected:
  SequenceFolder() {
    writeGrayImage(folder_.path() / "left" / "a.png", GrayImage(4, 3, 10));
    writeGrayImage(folder_.path() / "left" / "b.png", GrayImage(4, 3, 20));
    folder_.write("rig.yaml", "");
    folder_.write("plate.yaml", "");
    folder_.write("sequence.yaml",
                  "name: two\nrate_hz: 50\nrig: rig.yaml\ntarget: plate.yaml\n"
                  "start: [0.1, 0.2, 1.3, 0, 0, 0, 1]\n");
    folder_.write("frames.csv", "frame,time_s,left\n7,0.5,left/a.png\n8,0.52,left/b.png\n");
  }
  std::string refusal() {
    return messageOf<InputError>([this] { (void)openSequence(folder_.path()); });
  }
  ScratchFolder folder_;
};

TEST_F(SequenceFolder, TellsWhatIsStored) {
  folder_.write("truth.csv", "time_s,x,y,z,qx,qy,qz,qw\n0.5,1,2,3,0,0,0.70710678,0.70710678\n");
  const Sequence sequence = openSequence(folder_.path());
  EXPECT_EQ(sequence.name, "two");
  EXPECT_EQ(sequence.rate_hz, 50.0);
  ASSERT_EQ(sequence.frames.size(), 2U);
  EXPECT_EQ(sequence.frames[1].frame, 8U);
  EXPECT_EQ(sequence.frames[1].time.nanoseconds(), 520'000'000);
  EXPECT_TRUE(sequence.frames[0].right.empty());
  EXPECT_EQ(sequence.target_file, folder_.path() / "plate.yaml");
  EXPECT_NEAR(sequence.c1Mo_start->translation().z(), 1.3, 1e-12);
  ASSERT_EQ(sequence.c1Mo_truth.size(), 1U);
  // A quarter turn about z takes x to y.
  EXPECT_NEAR((sequence.c1Mo_truth[0].pose.linear() * Eigen::Vector3d::UnitX()).y(), 1.0, 1e-7);
}

TEST_F(SequenceFolder, RefusesTimeThatDoesNotGrow) {
  folder_.write("frames.csv", "frame,time_s,left\n0,0.5,left/a.png\n1,0.5,left/b.png\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("frames.csv line 3, column time_s"), HasSubstr("grow")));
}

TEST_F(SequenceFolder, NamesAMissingImage) {
  folder_.write("frames.csv", "frame,time_s,left\n0,0.5,left/a.png\n1,0.6,left/c.png\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("line 3, column left"), HasSubstr("left/c.png")));
}

TEST_F(SequenceFolder, NamesAMissingColumn) {
  folder_.write("frames.csv", "frame,left\n0,left/a.png\n");
  EXPECT_THAT(refusal(), HasSubstr("column time_s"));
}

TEST_F(SequenceFolder, NamesABadKey) {
  folder_.write("sequence.yaml", "name: two\nrate_hz: fast\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("sequence.yaml"), HasSubstr("rate_hz")));
  folder_.write("sequence.yaml", "name: two\nrate_hz: 50\nrig: none.yaml\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("key rig"), HasSubstr("none.yaml")));
  folder_.write("sequence.yaml", "name: two\nrate_hz: 50\nstart: [0, 0, 1]\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("key start"), HasSubstr("seven numbers")));
}

TEST_F(SequenceFolder, NamesTheLineOfBrokenYaml) {
  folder_.write("sequence.yaml", "name: two\nrate_hz: [50\n");
  EXPECT_THAT(refusal(), HasSubstr("sequence.yaml"));
}

TEST_F(SequenceFolder, RefusesAFolderWithoutASequence) {
  std::filesystem::remove(folder_.path() / "sequence.yaml");
  EXPECT_THAT(refusal(), HasSubstr("sequence.yaml"));
}

TEST(PoseText, ReadsVispsPosFiles) {
  const ScratchFolder folder;
  const auto file = folder.write("start.pos", "0.1\n0.2\n0.5\n0\n0\n1.5707963267948966\n");
  const Pose pose = poseFromText(file.string(), "--start");
  EXPECT_NEAR(pose.translation().y(), 0.2, 1e-15);
  EXPECT_NEAR((pose.linear() * Eigen::Vector3d::UnitX()).y(), 1.0, 1e-12);
}

TEST(PoseText, RefusesAQuaternionThatIsNone) {
  EXPECT_THAT(messageOf<InputError>([] { (void)poseFromText("0,0,1,0,0,0,2", "--start"); }),
              AllOf(HasSubstr("--start"), HasSubstr("norm 1")));
}

std::string sensorYaml(double x) {
  return "sensor_type: camera\nrate_hz: 20\nresolution: [6, 4]\nintrinsics: [5.0, 5.5, 3.0, 2.0]\n"
         "distortion_model: radial-tangential\n"
         "distortion_coefficients: [-0.1, 0.02, 0.001, -0.002]\n"
         "T_BS:\n  cols: 4\n  rows: 4\n  data: [1, 0, 0, " +
         std::to_string(x) + ", 0, 1, 0, 0.5, 0, 0, 1, 0, 0, 0, 0, 1]\n";
}

TEST(AslFolder, GivesRigAndSharedFrames) {
  const ScratchFolder folder;
  for (const std::string camera : {"cam0", "cam1"}) {
    folder.write("mav0/" + camera + "/sensor.yaml", sensorYaml(camera == "cam0" ? 0.1 : 0.4));
    for (const std::string stamp : {"1000000000", "1050000000"}) {
      writeGrayImage(folder.path() / "mav0" / camera / "data" / (stamp + ".png"), GrayImage(6, 4));
    }
  }
  folder.write("mav0/cam0/data.csv",
               "#timestamp [ns],filename\n1000000000,1000000000.png\n1050000000,1050000000.png\n");
  folder.write("mav0/cam1/data.csv", "#timestamp [ns],filename\n1050000000,1050000000.png\n");
  const Sequence sequence = openSequence(folder.path());
  ASSERT_EQ(sequence.frames.size(), 1U);
  EXPECT_EQ(sequence.frames[0].time.nanoseconds(), 1'050'000'000);
  ASSERT_TRUE(sequence.rig && sequence.rig->right);
  // The right camera stands 0.3 m along x, so the left one's origin is at -0.3 in it.
  EXPECT_NEAR(sequence.rig->c2Mc1.translation().x(), -0.3, 1e-12);
  EXPECT_EQ(sequence.rig->left.K(0, 2), 3.0);
  EXPECT_EQ(sequence.rig->left.distortion(3), -0.002);
}

}  // namespace
}  // namespace ringhook
