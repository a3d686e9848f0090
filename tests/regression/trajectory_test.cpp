// `ringhook evaluate trajectory` and `compare` as the program runs them: bad input, and real data
// where it is at hand (environment variable RINGHOOK_DATA, or ../shared/data beside the sources).

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/scratch_folder.h"
#include "evaluate_command.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class TrajectoryCommand : public ::testing::Test {
 protected:
  TrajectoryCommand() {
    std::string text = "time_s,angle_rad\n";
    for (int i = 0; i < 400; ++i) {
      const double t = 0.01 * i;
      text += std::to_string(t) + "," + std::to_string(0.2 * std::cos(5.0 * t)) + "\n";
    }
    write("swing.csv", text);
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  [[nodiscard]] CommandResult run(std::vector<std::string> more) const {
    more.insert(more.begin(), {"trajectory", path("swing.csv"), "--out", path("out")});
    return runEvaluate(more);
  }
  void expectRefused(const std::vector<std::string>& more, const std::string& words) const {
    const CommandResult result = run(more);
    EXPECT_EQ(result.exit_code, 2) << result.message;
    EXPECT_THAT(result.message, AllOf(HasSubstr(words), Not(HasSubstr("\n"))));
    EXPECT_EQ(filesBelow(folder_ / "out"), 0);
  }
  ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
};

TEST_F(TrajectoryCommand, WritesItsThreeFilesAndTheJson) {
  const auto result = run({"--json", path("told.json"), "--horizons", "0.1,0.3"});
  EXPECT_EQ(result.exit_code, 0) << result.message;
  for (const char* name : {"out/report.html", "out/summary.json", "out/frames.csv", "told.json"}) {
    EXPECT_TRUE(fs::is_regular_file(folder_ / name)) << name;
  }
}

TEST_F(TrajectoryCommand, RefusesBadOptionsInOneSentence) {
  expectRefused({"--models", "crystal-ball"}, "constant-acceleration");
  expectRefused({"--horizons", "0"}, "--horizons");
  expectRefused({"--horizons", "-0.2"}, "--horizons");
  expectRefused({"--horizons", "60"}, "--horizons 60");
  expectRefused({"--horizons", "soon"}, "--horizons");
  expectRefused({"--rate", "50"}, "time_s");
  expectRefused({"--columns", "x"}, "--columns x");
  expectRefused({"--columns", "x=y,x=z"}, "each name once");
  expectRefused({"--columns", "x=nothing"}, "nothing");
  expectRefused({"--noise", "-1"}, "--noise");
}

TEST_F(TrajectoryCommand, RefusesBadFilesByLineAndColumn) {
  write("swing.csv", "time_s,angle_rad\n0,0\n0.1,1\n0.1,2\n");
  expectRefused({}, "swing.csv line 4, column time_s");
  write("swing.csv", "time_s,angle\n0,0\n");
  expectRefused({}, "swing.csv line 1");
  fs::remove(folder_ / "swing.csv");
  expectRefused({}, "swing.csv");
}

TEST_F(TrajectoryCommand, AMainModelThatNeverBeginsIsAFailedJob) {
  std::string text = "time_s,angle_rad\n";
  for (int i = 0; i < 300; ++i) {
    text += std::to_string(0.01 * i) + "," + std::to_string(1e-3 * ((i * 7919) % 13)) + "\n";
  }
  write("swing.csv", text);
  const auto result = run({"--models", "exact-pendulum,constant-velocity"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.message, HasSubstr("never began"));
}

TEST_F(TrajectoryCommand, CompareRefusesWhatItCannotCompare) {
  const auto compared = [this](const std::string& align) {
    return runEvaluate({"compare", path("swing.csv"), path("swing.csv"), "--align", align});
  };
  EXPECT_EQ(compared("se3").exit_code, 2);
  EXPECT_THAT(compared("se3").message, HasSubstr("swing.csv line 1"));
  EXPECT_THAT(compared("best").message, HasSubstr("expected none, se3 or sim3"));
}

// Real data.

constexpr auto kCompared = "spherical-pendulum,exact-pendulum,constant-acceleration";

class RecordedTrajectories : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* told = std::getenv("RINGHOOK_DATA");
    data_ = told != nullptr ? fs::path(told) : fs::path(RINGHOOK_SOURCE_DIR) / "../shared/data";
    if (!fs::is_directory(data_)) {
      GTEST_SKIP() << "no recorded trajectories here: set RINGHOOK_DATA to their folder";
    }
  }
  nlohmann::json evaluated(std::vector<std::string> arguments) {
    const fs::path json = folder_ / "result.json";
    arguments.insert(arguments.end(), {"--json", json.string()});
    const auto result = runEvaluate(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.message;
    return result.exit_code == 0 ? nlohmann::json::parse(std::ifstream(json)) : nlohmann::json{};
  }
  nlohmann::json swing(int segment) {
    const auto file = data_ / "encoder-pendulum" / ("segment_" + std::to_string(segment) + ".csv");
    // One period: 2 pi sqrt(0.153 / 9.81) = 0.785 s, and 8 % more at the first swing's amplitude.
    return evaluated({"trajectory", file.string(), "--horizons", "0.2", "--warm-up", "0.85",
                      "--models", kCompared});
  }
  nlohmann::json flight(int number) {
    const auto file = data_ / "slung-load" / ("flight_" + std::to_string(number) + ".csv");
    return evaluated({"trajectory", file.string(), "--rate", "29.3", "--columns",
                      "x=load_x,y=load_y,z=load_z", "--horizons", "0.5", "--models", kCompared});
  }
  fs::path data_;
  ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
};

double rmsOf(const nlohmann::json& json, const char* model, const char* key) {
  return json["models"][model]["horizons"][0][key].get<double>();
}

// The published effective length is 0.1528 m; the swing of segment 4 begins with 0.73 rad, which
// lengthens the period by 3.4 % (a^2/16) and the length that a linear law finds by 7 %.
TEST_F(RecordedTrajectories, AnEncoderPendulumHasItsPublishedLengthUpToItsAmplitude) {
  const auto json = swing(4);
  EXPECT_NEAR(json["models"]["exact-pendulum"]["parameters"]["length_m"], 0.1528 * 1.07, 0.002);
  EXPECT_LT(rmsOf(json, "exact-pendulum", "rms"), 0.010);
  EXPECT_GT(rmsOf(json, "constant-acceleration", "rms"), 0.2);
}

TEST_F(RecordedTrajectories, ASwingsPeriodIsEnoughToPredictEveryEncoderPendulumTo6Milliradians) {
  for (const int segment : {1, 2, 3, 4}) {
    const auto json = swing(segment);
    EXPECT_LE(rmsOf(json, "spherical-pendulum", "rms"), 0.006) << segment;
    EXPECT_NEAR(json["models"]["spherical-pendulum"]["parameters"]["length_m"], 0.15276, 0.0015)
        << segment;
  }
}

TEST_F(RecordedTrajectories, APendulumBelowAMovingPivotBeatsConstantAccelerationOnEveryFlight) {
  for (const int number : {15, 16, 17, 18}) {
    const auto json = flight(number);
    for (const char* pendulum : {"spherical-pendulum", "exact-pendulum"}) {
      EXPECT_LE(rmsOf(json, pendulum, "horizontal_rms"),
                0.6 * rmsOf(json, "constant-acceleration", "horizontal_rms"))
          << pendulum << number;
    }
  }
}

TEST_F(RecordedTrajectories, KittiHasItsPublishedError) {
  const auto folder = data_ / "trajectory-ape";
  const auto json = evaluated({"compare", (folder / "KITTI_00_gt.txt").string(),
                               (folder / "KITTI_00_ORB.txt").string(), "--align", "se3"});
  EXPECT_NEAR(json["rmse_m"], 1.3034497, 2e-6);
  EXPECT_NEAR(json["mean_m"], 1.1569971, 2e-6);
  EXPECT_NEAR(json["max_m"], 3.5879501, 2e-6);
  EXPECT_EQ(json["pairs"], 4541);
}

}  // namespace
}  // namespace ringhook
