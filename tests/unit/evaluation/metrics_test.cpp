#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "../../support/scratch_folder.h"
#include "core/error.h"
#include "evaluation/evaluation_method.h"
#include "evaluation/pose_error.h"
#include "evaluation/trajectory_io.h"

namespace ringhook {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(ErrorStatistics, AreThoseOfTheTextbook) {
  const ErrorStatistics s = errorStatistics({1.0, 2.0, 3.0, 6.0});
  EXPECT_EQ(s.count, 4U);
  EXPECT_DOUBLE_EQ(s.mean, 3.0);
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(14.0 / 3.0));
  EXPECT_DOUBLE_EQ(s.rms, std::sqrt(50.0 / 4.0));
  EXPECT_DOUBLE_EQ(s.max, 6.0);
}

TEST(ErrorStatistics, OfNothingAreZero) {
  EXPECT_EQ(errorStatistics({}).count, 0U);
  EXPECT_EQ(errorStatistics({}).rms, 0.0);
  EXPECT_EQ(errorStatistics({4.0}).std, 0.0);
}

TEST(Percentile, IsTheNearestRank) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) {
    values.push_back(i);
  }
  EXPECT_EQ(percentile(values, 50.0), 50.0);
  EXPECT_EQ(percentile(values, 99.0), 99.0);
  EXPECT_EQ(percentile({7.0}, 95.0), 7.0);
}

TEST(PoseError, RotationIsTheAngleBetweenBoth) {
  const Pose truth = makePoseThetaU({1, 2, 3}, {0.4, -0.3, 0.9});
  const double angle = 0.2;
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -2) / 3.0;
  const Pose estimate = truth * makePoseThetaU({0, 0.003, 0.004}, angle * axis);
  EXPECT_NEAR(rotationError(estimate, truth), angle, 1e-12);
  EXPECT_NEAR(positionError(estimate, truth), 0.005, 1e-12);
}

TEST(PoseAt, LiesBetweenItsNeighboursAndNotBeyond) {
  const std::vector<StampedPose> poses = {
      {Time::fromSeconds(1.0), makePoseThetaU({0, 0, 1}, {0, 0, 0})},
      {Time::fromSeconds(2.0), makePoseThetaU({1, 0, 1}, {0, 0, 0.4})}};
  const auto middle = poseAt(poses, Time::fromSeconds(1.25));
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->translation().x(), 0.25, 1e-12);
  EXPECT_NEAR(thetaU(middle->linear()).z(), 0.1, 1e-9);
  EXPECT_TRUE(poseAt(poses, Time::fromSeconds(2.00005)));
  EXPECT_FALSE(poseAt(poses, Time::fromSeconds(2.01)));
  EXPECT_FALSE(poseAt(poses, Time::fromSeconds(0.99)));
}

class TumFile : public ::testing::Test {
 protected:
  std::string refusalOf(const std::string& text) {
    std::ofstream(path_) << text;
    try {
      (void)readTum(path_);
    } catch (const InputError& e) {
      return e.what();
    }
    return {};
  }
  ScratchFolder folder_;
  std::filesystem::path path_ = folder_.path() / "file.tum";
};

TEST_F(TumFile, WhatIsWrittenIsRead) {
  const std::vector<StampedPose> poses = {
      {Time::fromSeconds(0.02), makePoseThetaU({0.1, -0.2, 1.3}, {0.3, 0.2, -0.1})},
      {Time::fromSeconds(0.04), makePoseThetaU({0.1, -0.2, 1.4}, {3.0, 0.2, -0.1})}};
  writeTum(path_, poses);
  const auto read = readTum(path_);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].time, poses[1].time);
  EXPECT_TRUE(read[1].pose.isApprox(poses[1].pose, 1e-8));
}

TEST_F(TumFile, NamesTheLineThatIsWrong) {
  EXPECT_THAT(refusalOf("# c\n0 0 0 1 0 0 0 1\n1 0 0 1 0 0 0\n"),
              AllOf(HasSubstr("line 3"), HasSubstr("found 7")));
  EXPECT_THAT(refusalOf("0 0 0 1 0 0 0 1\n0 0 0 1 0 0 0 1\n"), HasSubstr("line 2: time must grow"));
  EXPECT_THAT(refusalOf("0 0 0 one 0 0 0 1\n"), HasSubstr("'one'"));
  EXPECT_THAT(refusalOf("0 0 0 1 0 0 0 3\n"), HasSubstr("norm 1"));
  EXPECT_THAT(refusalOf("# nothing\n"), HasSubstr("no pose"));
}

std::string methodRefusal(const std::string& name, const std::string& target, bool stereo) {
  try {
    (void)makeMethod(name, target, "", stereo);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(Methods, AnUnknownNameListsTheKnownOnes) {
  EXPECT_THAT(methodRefusal("egdes", "a.cao", false),
              AllOf(HasSubstr("egdes"), HasSubstr("edges-visp"), HasSubstr("marker-midpoint")));
}

TEST(Methods, MustFitTargetAndCameras) {
  EXPECT_THAT(methodRefusal("edges", "plate.yaml", true), HasSubstr("plate.yaml"));
  EXPECT_THAT(methodRefusal("marker-joint", "a.cao", true), HasSubstr("a.cao"));
  EXPECT_THAT(methodRefusal("marker-midpoint", "plate.yaml", false), HasSubstr("two cameras"));
  EXPECT_THAT(methodRefusal("edges", "a.stl", true), HasSubstr("a.stl"));
}

TEST(Methods, DefaultFollowsTheTarget) {
  EXPECT_EQ(defaultMethod("hook.cao"), "edges");
  EXPECT_EQ(defaultMethod("marker.yaml"), "marker-joint");
}

}  // namespace
}  // namespace ringhook
