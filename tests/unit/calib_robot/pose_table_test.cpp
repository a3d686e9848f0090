// Tables and pose files as people write them, and the mistakes in them.

#include "calib/solve/pose_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "calib/solve/point_fit.h"
#include "calib/solve/pose_pairs.h"
#include "core/error.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr auto kHeader =
    "robot_x,robot_y,robot_z,robot_qx,robot_qy,robot_qz,robot_qw,"
    "target_x,target_y,target_z,target_qx,target_qy,target_qz,target_qw\n";

class PoseFiles : public ::testing::Test {
 protected:
  PoseFiles() {
    folder_ = fs::path(RINGHOOK_BINARY_DIR) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::create_directories(folder_);
  }
  ~PoseFiles() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  template <class Read>
  static std::string refusal(const Read& read) {
    try {
      read();
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), Not(HasSubstr("\n")));
      return e.what();
    }
    return "nothing was refused";
  }
  [[nodiscard]] std::string pairsRefusal(const std::string& rows) const {
    const fs::path path = file("pairs.csv", kHeader + rows);
    return refusal([&] { (void)readPosePairs(path); });
  }
  fs::path folder_;
};

TEST_F(PoseFiles, ReadPairsInTheWrittenOrderOfQuaternions) {
  const auto pairs = readPosePairs(
      file("pairs.csv", std::string(kHeader) + "0.1,0.2,0.3,1,0,0,0,0.4,0.5,0.6,0,0,0,1\n"));
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].name, "pairs.csv line 2");
  EXPECT_LT((pairs[0].fMe.translation() - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 1e-15);
  EXPECT_LT((pairs[0].fMe.linear().diagonal() - Eigen::Vector3d(1, -1, -1)).norm(), 1e-15);
  EXPECT_TRUE(pairs[0].cMt.linear().isIdentity(1e-15));
}

TEST_F(PoseFiles, RefuseEachMistakeInPairsInItsOwnSentence) {
  EXPECT_THAT(pairsRefusal("400,0,0,0,0,0,1,0,0,1,0,0,0,1\n"),
              AllOf(HasSubstr("line 2, column robot_x"), HasSubstr("looks like millimetres")));
  EXPECT_THAT(pairsRefusal("0,0,0,0,0,0,1,0,0,812.5,0,0,0,1\n"),
              AllOf(HasSubstr("column target_z"), HasSubstr("looks like millimetres")));
  EXPECT_THAT(pairsRefusal("0,0,0,0,0,0,1,0,0,1,10,90,-45,0\n"),
              AllOf(HasSubstr("column target_qx"), HasSubstr("angles in degrees")));
  EXPECT_THAT(pairsRefusal("0,0,0,0.5,0,0,0.5,0,0,1,0,0,0,1\n"),
              AllOf(HasSubstr("column robot_qx"), HasSubstr("length 1"), HasSubstr("0.7071")));
  EXPECT_THAT(pairsRefusal("nan,0,0,0,0,0,1,0,0,1,0,0,0,1\n"), HasSubstr("column robot_x"));
  EXPECT_THAT(pairsRefusal("0,0,0,0,0,0,1\n"), HasSubstr("line 2"));
  EXPECT_THAT(pairsRefusal(""), HasSubstr("at least one row"));
}

TEST_F(PoseFiles, RefuseFilesThatAreNoTables) {
  EXPECT_THAT(refusal([&] { (void)readPosePairs(folder_); }), HasSubstr("cannot read"));
  EXPECT_THAT(refusal([&] { (void)readPosePairs(folder_ / "none.csv"); }), HasSubstr("none.csv"));
  const fs::path empty = file("empty.csv", "");
  EXPECT_THAT(refusal([&] { (void)readPosePairs(empty); }), HasSubstr("empty"));
  const fs::path other = file("other.csv", "a,b\n1,2\n");
  EXPECT_THAT(refusal([&] { (void)readPosePairs(other); }), HasSubstr("robot_x"));
  EXPECT_THAT(refusal([&] { (void)readPointPairs(other); }), HasSubstr("robot_x"));
}

TEST_F(PoseFiles, ReadVispPoses) {
  const Pose pose = readVispPose(file("pose.yaml",
                                      "rows: 6\ncols: 1\ndata:\n  - [0.7]\n  - [-0.03]\n  - "
                                      "[0.4]\n  - [0]\n  - [0]\n  - [1.5708]\n"));
  EXPECT_LT((pose.translation() - Eigen::Vector3d(0.7, -0.03, 0.4)).norm(), 1e-15);
  EXPECT_NEAR(pose.linear()(1, 0), 1.0, 1e-9);
}

TEST_F(PoseFiles, RefuseVispPosesInDegreesMillimetresOrPieces) {
  const auto refused = [&](const std::string& data) {
    const fs::path path = file("pose.yaml", "rows: 6\ncols: 1\ndata:\n" + data);
    return refusal([&] { (void)readVispPose(path); });
  };
  EXPECT_THAT(refused("- [0.7]\n- [0]\n- [0.4]\n- [0]\n- [0]\n- [90]\n"), HasSubstr("degrees"));
  EXPECT_THAT(refused("- [700]\n- [0]\n- [0.4]\n- [0]\n- [0]\n- [1]\n"),
              AllOf(HasSubstr("line 4"), HasSubstr("millimetres")));
  EXPECT_THAT(refused("- [0.7]\n- [0]\n"), HasSubstr("six values"));
  EXPECT_THAT(refused("- [0.7]\n- [far]\n"), HasSubstr("line 5"));
}

TEST(PoseSetup, ReadsBothNamesAndRefusesOthers) {
  EXPECT_EQ(parseSetup("eye-to-hand"), EyeSetup::kEyeToHand);
  EXPECT_EQ(parseSetup("eye-in-hand"), EyeSetup::kEyeInHand);
  EXPECT_THROW(parseSetup("eye"), InputError);
}

}  // namespace
}  // namespace ringhook
