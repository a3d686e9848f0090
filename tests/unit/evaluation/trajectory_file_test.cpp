#include "evaluation/trajectory_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "../../support/scratch_folder.h"
#include "core/error.h"
#include "evaluation/sample_noise.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

/// Reads `text` as a file "swing.csv".
Trajectory read(const std::string& text, const TrajectoryFileOptions& options = {}) {
  const ScratchFolder folder;
  return readTrajectory(folder.write("swing.csv", text), options);
}

/// The sentence with which it is refused; empty if it is not.
std::string refusal(const std::string& text, const TrajectoryFileOptions& options = {}) {
  try {
    static_cast<void>(read(text, options));
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(TrajectoryFile, TheHeaderDecidesWhatItIs) {
  const Trajectory one = read("time_s,angle_rad,rate_rad_s\n0,0.1,9\n0.5,0.2,9\n");
  EXPECT_EQ(one.name, "swing");
  EXPECT_EQ(one.kind, TrajectoryKind::kAngle);
  EXPECT_EQ(one.times[1], Time::fromSeconds(0.5));
  EXPECT_EQ(one.values[1](0), 0.2);
  const Trajectory two = read("angle2_rad,time_s,angle_rad\n1,0,0.1\n2,0.5,0.2\n");
  EXPECT_EQ(two.kind, TrajectoryKind::kTwoAngles);
  EXPECT_EQ(two.values[1], Eigen::Vector2d(0.2, 2.0));
  const Trajectory point = read("time_s,x,y,z\n0,1,2,3\n1,4,5,6\n");
  EXPECT_EQ(point.kind, TrajectoryKind::kPoint);
  EXPECT_EQ(point.values[1], Eigen::Vector3d(4, 5, 6));
  const Trajectory both =
      read("time_s,pivot_x,pivot_y,pivot_z,x,y,z\n0,1,2,3,4,5,6\n1,7,8,9,10,11,12\n");
  EXPECT_EQ(both.kind, TrajectoryKind::kPointAndPivot);
  EXPECT_EQ(both.values[0].transpose(), (Eigen::RowVectorXd(6) << 4, 5, 6, 1, 2, 3).finished());
}

TEST(TrajectoryFile, OtherColumnNamesAndARateAreTold) {
  const Trajectory load =
      read("pivot_x,pivot_y,pivot_z,load_x,load_y,load_z\n1,2,3,4,5,6\n1,2,3,4,5,7\n",
           {{{"x", "load_x"}, {"y", "load_y"}, {"z", "load_z"}}, 20.0});
  EXPECT_EQ(load.kind, TrajectoryKind::kPointAndPivot);
  EXPECT_EQ(load.times[1], Time::fromSeconds(0.05));
  EXPECT_EQ(load.values[1](2), 7.0);
}

TEST(TrajectoryFile, RefusesColumnsThatDoNotMakeATrajectory) {
  EXPECT_THAT(refusal("time_s,p,q\n0,1,2\n1,2,3\n"),
              HasSubstr("swing.csv line 1: expected either angle_rad[,angle2_rad] or x,y,z"));
  EXPECT_THAT(refusal("time_s,angle_rad,x,y,z\n0,1,2,3,4\n1,1,2,3,4\n"), HasSubstr("found both"));
  EXPECT_THAT(refusal("time_s,angle2_rad\n0,1\n1,2\n"), HasSubstr("angle_rad beside angle2_rad"));
  EXPECT_THAT(refusal("time_s,x,y\n0,1,2\n1,2,3\n"), HasSubstr("expected a column z"));
  EXPECT_THAT(refusal("time_s,x,y,z,pivot_y\n0,1,2,3,4\n1,1,2,3,4\n"),
              HasSubstr("expected a column pivot_x"));
  EXPECT_THAT(refusal("time_s,x,y,z\n0,1,2,3\n1,1,2,3\n", {{{"x", "load_x"}}, {}}),
              HasSubstr("expected a column load_x"));
  EXPECT_THAT(refusal("time_s,x,y,z\n0,1,2,3\n1,1,2,3\n", {{{"w", "x"}}, {}}),
              HasSubstr("--columns w=x: expected one of time_s"));
}

TEST(TrajectoryFile, RefusesTimeThatIsMissingTwiceToldOrDoesNotGrow) {
  EXPECT_THAT(refusal("angle_rad\n0\n1\n"), HasSubstr("a column time_s, or --rate"));
  EXPECT_THAT(refusal("time_s,angle_rad\n0,0\n1,1\n", {{}, 10.0}),
              HasSubstr("expected no column time_s beside --rate"));
  EXPECT_THAT(refusal("time_s,angle_rad\n0,0\n\n0,1\n"),
              HasSubstr("swing.csv line 4, column time_s: time must grow"));
  EXPECT_THAT(refusal("time_s,angle_rad\n0,0\n1e10,1\n"), HasSubstr("expected a time in seconds"));
  for (const double rate : {0.0, -3.0, std::nan(""), 1e9}) {
    EXPECT_THAT(refusal("angle_rad\n0\n1\n", {{}, rate}), HasSubstr("--rate: expected"));
  }
}

TEST(TrajectoryFile, RefusesWhatIsNoNumberNamingLineAndColumn) {
  EXPECT_THAT(refusal("time_s,angle_rad\n0,0\n1,nan\n"),
              HasSubstr("swing.csv line 3, column angle_rad: expected a number, found 'nan'"));
  EXPECT_THAT(refusal("time_s,x,y,z\n0,0,0,0\n1,0,1e7,0\n"),
              HasSubstr("line 3, column y: expected radians or metres"));
  EXPECT_THAT(refusal("time_s,angle_rad\n0,0\n"), HasSubstr("fewer than two samples"));
}

TEST(TrajectoryFile, FindsTheSamplesThatASourceHeld) {
  const Trajectory held = read("x,y,z\n1,2,3\n1,2,3\n1,2,4\n1,2,4\n1,2,3\n", {{}, 10.0});
  EXPECT_EQ(repeatedSamples(held), 2U);
  const Trajectory fresh = withoutRepeated(held);
  ASSERT_EQ(fresh.times.size(), 3U);
  EXPECT_EQ(fresh.times[1], Time::fromSeconds(0.2));
  EXPECT_EQ(fresh.values[2](2), 3.0);
}

Trajectory noisySwing(double sigma, double step_s, double rounded_to) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  Trajectory swing{"swing", TrajectoryKind::kTwoAngles, {}, {}};
  for (int i = 0; i < 3000; ++i) {
    const double t = step_s * i;
    Eigen::Vector2d value(0.8 * std::sin(8.0 * t) + sigma * normal(random),
                          0.3 * std::cos(3.0 * t) + sigma * normal(random));
    if (rounded_to > 0.0) {
      value = (value.array() / rounded_to).round() * rounded_to;
    }
    swing.times.push_back(Time::fromSeconds(t));
    swing.values.emplace_back(value);
  }
  return swing;
}

TEST(SampleNoise, IsTheNoiseWhateverTheMotion) {
  EXPECT_NEAR(estimateSampleNoise(noisySwing(1e-3, 0.005, 0.0)), 1e-3, 1e-4);
  EXPECT_NEAR(estimateSampleNoise(noisySwing(2e-3, 0.02, 0.0)), 2e-3, 2e-4);
  EXPECT_LT(estimateSampleNoise(noisySwing(0.0, 0.005, 0.0)), 1e-6);
  EXPECT_GE(estimateSampleNoise(noisySwing(0.0, 0.005, 0.0)), 1e-9);
}

TEST(SampleNoise, IsNotLessThanTheRoundingOfTheFile) {
  const double sigma = estimateSampleNoise(noisySwing(0.0, 0.005, 1e-3));
  EXPECT_GT(sigma, 0.9 * 1e-3 / std::sqrt(12.0));
  EXPECT_LT(sigma, 2.0 * 1e-3 / std::sqrt(12.0));
}

TEST(SampleNoise, SingleJumpsDoNotCount) {
  Trajectory swing = noisySwing(1e-3, 0.005, 0.0);
  for (std::size_t i = 100; i < swing.values.size(); i += 300) {
    swing.values[i](0) += 0.5;
  }
  EXPECT_NEAR(estimateSampleNoise(swing), 1e-3, 2e-4);
}

}  // namespace
}  // namespace ringhook
