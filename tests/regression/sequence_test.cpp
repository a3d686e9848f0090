#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/scratch_folder.h"
#include "evaluate_command.h"
#include "evaluation/trajectory_io.h"

namespace ringhook {
namespace {

const std::filesystem::path kDatasets = std::filesystem::path(RINGHOOK_SOURCE_DIR) / "datasets";

nlohmann::json summaryOf(const std::filesystem::path& folder) {
  return nlohmann::json::parse(std::ifstream(folder / "summary.json"));
}

TEST(RealPhotographs, TheCubeIsTrackedInEveryFrame) {
  const ScratchFolder scratch;
  const auto out = scratch.path();
  const auto result = runEvaluate({"sequence", (kDatasets / "visp-cube").string(), "--method",
                                   "edges,edges-visp", "--out", out.string()});
  ASSERT_EQ(result.exit_code, 0) << result.message;
  const auto summary = summaryOf(out);
  EXPECT_EQ(summary.at("frames"), 218);
  EXPECT_EQ(summary.at("frames_tracked"), 218);
  EXPECT_EQ(summary.at("losses"), 0);
  EXPECT_EQ(summary.at("methods").at("edges-visp").at("frames_tracked"), 218);
  EXPECT_EQ(readTum(out / "estimate.tum").size(), 218U);
}

// ViSP's own limits for its edge tracker on this sequence: 7 mm and 3.7 degrees in the worst frame.
TEST(Castle, StaysWithinVispsOwnLimits) {
  const ScratchFolder scratch;
  const auto out = scratch.path();
  const auto result = runEvaluate({"sequence", (kDatasets / "visp-castle").string(), "--method",
                                   "edges,edges-visp", "--gate-mm", "7", "--out", out.string()});
  ASSERT_EQ(result.exit_code, 0) << result.message;
  const auto summary = summaryOf(out);
  for (const auto* method : {"edges", "edges-visp"}) {
    const auto& m = summary.at("methods").at(method);
    EXPECT_EQ(m.at("frames_tracked"), 40) << method;
    EXPECT_EQ(m.at("false_poses"), 0) << method;
    EXPECT_LE(m.at("position_error_mm").at("max"), 7.0) << method;
    EXPECT_LE(m.at("rotation_error_deg").at("max"), 3.7) << method;
  }
  for (const auto* file : {"report.html", "frames.csv", "frames-edges-visp.csv"}) {
    EXPECT_TRUE(std::filesystem::exists(out / file)) << file;
  }
}

}  // namespace
}  // namespace ringhook
