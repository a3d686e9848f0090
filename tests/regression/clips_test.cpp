// The small clips of the simulated cell under datasets/clips, each against its truth.

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/scratch_folder.h"
#include "camera/sequence.h"
#include "evaluate_command.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

const fs::path kClips = fs::path(RINGHOOK_SOURCE_DIR) / "datasets/clips";

/// What a clip must give; bounds are about three times what it gave when it was recorded.
struct ClipBounds {
  const char* name;
  std::size_t frames;
  std::size_t tracked;  ///< at least
  std::size_t losses;   ///< at most
  double mean_mm;       ///< at most
  double max_mm;        ///< at most
};

class Clip : public ::testing::TestWithParam<ClipBounds> {};

TEST_P(Clip, IsTrackedWithinItsBounds) {
  const ClipBounds& bounds = GetParam();
  const ScratchFolder scratch;
  const fs::path out = scratch.path();
  const auto result = runEvaluate(
      {"sequence", (kClips / bounds.name).string(), "--gate-mm", "15", "--out", out.string()});
  ASSERT_EQ(result.exit_code, 0) << result.message;
  std::ifstream file(out / "summary.json");
  const auto summary = nlohmann::json::parse(file);
  EXPECT_EQ(summary.at("frames"), bounds.frames);
  EXPECT_GE(summary.at("frames_tracked"), bounds.tracked);
  EXPECT_LE(summary.at("losses"), bounds.losses);
  EXPECT_EQ(summary.at("false_poses"), 0);
  EXPECT_LE(summary.at("position_error_mm").at("mean"), bounds.mean_mm);
  EXPECT_LE(summary.at("position_error_mm").at("max"), bounds.max_mm);
}

TEST_P(Clip, HasATruthForEveryFrameAndTheArmsStates) {
  const Sequence clip = openSequence(kClips / GetParam().name);
  ASSERT_EQ(clip.c1Mo_truth.size(), clip.frames.size());
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    EXPECT_EQ(clip.c1Mo_truth[i].time, clip.frames[i].time) << i;
  }
  EXPECT_GT(clip.robot.size(), clip.frames.size());
  EXPECT_EQ(clip.licence, "GPL-3.0-or-later");
  EXPECT_TRUE(fs::exists(kClips / GetParam().name / "truth/hooks.csv"));
}

INSTANTIATE_TEST_SUITE_P(Datasets, Clip,
                         ::testing::Values(ClipBounds{"swing-marker", 100, 100, 0, 1.0, 4.0},
                                           ClipBounds{"occluded-marker", 100, 95, 2, 1.2, 12.0},
                                           ClipBounds{"swing-edges", 40, 40, 0, 0.4, 0.8}),
                         [](const auto& clip) {
                           std::string name = clip.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Datasets, TheReadmeNamesEachAndTogetherTheClipsAreSmall) {
  std::ifstream file(kClips.parent_path() / "README.md");
  const std::string readme{std::istreambuf_iterator<char>(file), {}};
  for (const auto& entry : fs::directory_iterator(kClips.parent_path())) {
    if (entry.is_directory() && entry.path() != kClips) {
      EXPECT_THAT(readme, ::testing::HasSubstr("`" + entry.path().filename().string() + "`"));
    }
  }
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kClips)) {
    bytes += entry.is_regular_file() ? entry.file_size() : 0;
    if (entry.is_directory() && entry.path().parent_path() == kClips) {
      EXPECT_THAT(readme, ::testing::HasSubstr("`clips/" + entry.path().filename().string() + "`"));
    }
  }
  EXPECT_LT(bytes, 20'000'000U);
}

}  // namespace
}  // namespace ringhook
