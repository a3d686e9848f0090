#include "evaluation/trajectory_compare.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "../../support/scratch_folder.h"
#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

/// A curve in space, and what a camera that is turned, moved and scaled makes of it.
PositionPairs movedCurve(double scale) {
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
  PositionPairs pairs{Eigen::Matrix3Xd(3, 50), Eigen::Matrix3Xd(3, 50)};
  for (int i = 0; i < 50; ++i) {
    const double s = 0.1 * i;
    const Eigen::Vector3d p(3.0 * std::cos(s), s, std::sin(2.0 * s));
    pairs.reference.col(i) = p;
    pairs.estimate.col(i) = scale * (turn * p) + Eigen::Vector3d(5.0, -1.0, 2.0);
  }
  return pairs;
}

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(TrackError, IsZeroOnceARigidMotionIsTakenAway) {
  const TrackError aligned = trackError(movedCurve(1.0), Alignment::kSe3);
  EXPECT_LT(aligned.max_m, 1e-12);
  EXPECT_EQ(aligned.pairs, 50U);
  EXPECT_GT(trackError(movedCurve(1.0), Alignment::kNone).min_m, 0.1);
}

TEST(TrackError, AScaleIsTakenAwayOnlyWhenAskedFor) {
  const TrackError aligned = trackError(movedCurve(2.0), Alignment::kSim3);
  EXPECT_LT(aligned.max_m, 1e-12);
  EXPECT_NEAR(aligned.scale, 0.5, 1e-12);
  EXPECT_GT(trackError(movedCurve(2.0), Alignment::kSe3).rmse_m, 0.1);
}

TEST(TrackError, StatisticsAreThoseOfTheDistances) {
  PositionPairs pairs{Eigen::Matrix3Xd::Zero(3, 4), Eigen::Matrix3Xd::Zero(3, 4)};
  pairs.estimate.row(1) << 1.0, 2.0, 3.0, 6.0;
  const TrackError error = trackError(pairs, Alignment::kNone);
  EXPECT_NEAR(error.rmse_m, std::sqrt(12.5), 1e-12);
  EXPECT_NEAR(error.mean_m, 3.0, 1e-12);
  EXPECT_NEAR(error.median_m, 2.5, 1e-12);
  EXPECT_NEAR(error.std_m, std::sqrt(3.5), 1e-12);
  EXPECT_EQ(error.min_m, 1.0);
  EXPECT_EQ(error.max_m, 6.0);
}

TEST(TrackError, RefusesAnAlignmentThatALineLeavesOpen) {
  PositionPairs pairs = movedCurve(1.0);
  pairs.reference.bottomRows<2>().setZero();
  EXPECT_THAT(refusal([&] { static_cast<void>(trackError(pairs, Alignment::kSe3)); }),
              HasSubstr("--align none"));
  EXPECT_EQ(refusal([&] { static_cast<void>(trackError(pairs, Alignment::kNone)); }), "");
}

TEST(PairTracks, EachInstantIsUsedOnceAndOnlyWithinTheTolerance) {
  PositionTrack reference{true, {}, {}};
  PositionTrack estimate{true, {}, {}};
  for (int i = 0; i < 10; ++i) {
    reference.times.push_back(Time::fromSeconds(0.1 * i));
    reference.positions.emplace_back(i, 0.0, 0.0);
  }
  for (const double t : {0.004, 0.102, 0.11, 0.25, 0.497, 0.698, 5.0}) {
    estimate.times.push_back(Time::fromSeconds(t));
    estimate.positions.emplace_back(0.0, t, 0.0);
  }
  const PositionPairs pairs = pairTracks(reference, estimate, 0.01);
  ASSERT_EQ(pairs.reference.cols(), 4);
  EXPECT_EQ(pairs.reference.row(0), Eigen::RowVector4d(0.0, 1.0, 5.0, 7.0));
  EXPECT_EQ(pairs.estimate.row(1), Eigen::RowVector4d(0.004, 0.102, 0.497, 0.698));
}

class TrackFiles : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  ScratchFolder folder_;
};

constexpr auto kKittiLine = "1 0 0 1 0 1 0 2 0 0 1 3\n";

TEST_F(TrackFiles, TheNumbersInALineTellTheFormat) {
  const auto tum = readPositionTrack(write("a.tum", "# t x\n0.5 1 2 3 0 0 0 1\n1 1 2 4 0 0 0 1\n"));
  EXPECT_TRUE(tum.timed);
  EXPECT_EQ(tum.positions[1], Eigen::Vector3d(1, 2, 4));
  const auto kitti = readPositionTrack(write("a.txt", std::string(kKittiLine) + kKittiLine));
  EXPECT_FALSE(kitti.timed);
  EXPECT_EQ(kitti.positions.size(), 2U);
  EXPECT_EQ(kitti.positions[0], Eigen::Vector3d(1, 2, 3));
}

TEST_F(TrackFiles, WhatIsNoTrajectoryIsRefusedByFileAndLine) {
  const auto read = [this](const std::string& text) {
    const auto file = write("bad.txt", text);
    return refusal([&] { static_cast<void>(readPositionTrack(file)); });
  };
  EXPECT_THAT(read("1 2 3\n"), HasSubstr("bad.txt line 1: expected the 8 numbers"));
  EXPECT_THAT(read(std::string(kKittiLine) + "1 2 3\n"), HasSubstr("line 2: expected 12 numbers"));
  EXPECT_THAT(read("2 0 0 1 0 1 0 2 0 0 1 3\n"), HasSubstr("line 1: expected a rotation"));
  EXPECT_THAT(read("1 0 0 x 0 1 0 2 0 0 1 3\n"), HasSubstr("expected a number, found 'x'"));
  EXPECT_THAT(read("1 0 0 1e12 0 1 0 2 0 0 1 3\n"), HasSubstr("at most 1e9"));
  EXPECT_THAT(read("# nothing\n"), HasSubstr("holds no pose"));
  EXPECT_THAT(
      refusal([this] { static_cast<void>(readPositionTrack(folder_.path() / "absent.tum")); }),
      HasSubstr("absent.tum"));
}

TEST_F(TrackFiles, OfDifferentFormatsOrLengthsAreNotCompared) {
  const PositionTrack three{false, {}, std::vector<Eigen::Vector3d>(3)};
  const PositionTrack four{false, {}, std::vector<Eigen::Vector3d>(4)};
  const PositionTrack timed{true, {{}, {}, {}}, std::vector<Eigen::Vector3d>(3)};
  const auto pair = [](const PositionTrack& a, const PositionTrack& b) {
    return refusal([&] { static_cast<void>(pairTracks(a, b, 0.01)); });
  };
  EXPECT_THAT(pair(three, four), HasSubstr("found 3 and 4"));
  EXPECT_THAT(pair(three, timed), HasSubstr("one format"));
  EXPECT_EQ(pair(three, three), "");
}

TEST(TrackErrorJson, HoldsTheKeysThatProgramsRelyOn) {
  const auto json = nlohmann::json::parse(
      trackErrorJson(trackError(movedCurve(1.0), Alignment::kSe3), Alignment::kSe3));
  for (const char* key : {"rmse_m", "mean_m", "median_m", "std_m", "min_m", "max_m", "pairs"}) {
    EXPECT_TRUE(json[key].is_number()) << key;
  }
  EXPECT_EQ(json["alignment"], "se3");
}

}  // namespace
}  // namespace ringhook
