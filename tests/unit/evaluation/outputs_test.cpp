#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "evaluation/overlay.h"
#include "evaluation/report_page.h"
#include "evaluation/sequence_outputs.h"
#include "evaluation/summary_json.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// One tracked frame, 3 mm wrong, and one lost.
MethodRun smallRun(bool truth) {
  MethodRun run;
  run.name = "marker-joint";
  FrameRecord tracked;
  tracked.frame = 4;
  tracked.time = Time::fromSeconds(0.5);
  tracked.fix.emplace();
  tracked.fix->c1Mo = makePoseThetaU({0.1, 0.2, 1.3}, {0, 0, 0});
  tracked.fix->covariance.setConstant(std::numeric_limits<double>::quiet_NaN());
  tracked.fix->rms_px = 0.25;
  tracked.fix->features = 8;
  if (truth) {
    tracked.position_error = 0.003;
    tracked.rotation_error = 0.01;
  }
  FrameRecord lost;
  lost.frame = 5;
  lost.time = Time::fromSeconds(0.52);
  lost.reason = "no tag seen, at all";
  run.frames = {tracked, lost};
  return run;
}

TEST(SummaryJson, HasThePromisedKeys) {
  const auto json =
      nlohmann::json::parse(summaryJson({summarise(smallRun(true), 2.0)}, "clip", 2.0, false));
  EXPECT_EQ(json.at("frames"), 2);
  EXPECT_EQ(json.at("frames_tracked"), 1);
  EXPECT_EQ(json.at("losses"), 1);
  EXPECT_EQ(json.at("reacquisitions"), 0);
  EXPECT_EQ(json.at("false_poses"), 1);
  for (const auto* key : {"mean", "std", "rms", "max"}) {
    EXPECT_TRUE(json.at("position_error_mm").contains(key));
    EXPECT_TRUE(json.at("methods").at("marker-joint").at("rotation_error_deg").contains(key));
  }
  EXPECT_NEAR(json.at("position_error_mm").at("max").get<double>(), 3.0, 1e-9);
  EXPECT_TRUE(json.at("stage_ms").at("track").contains("p99"));
}

TEST(SummaryJson, LeavesErrorsOutWithoutTruth) {
  const auto json =
      nlohmann::json::parse(summaryJson({summarise(smallRun(false), 2.0)}, "clip", 2.0, false));
  EXPECT_FALSE(json.contains("position_error_mm"));
  EXPECT_FALSE(json.contains("false_poses"));
}

TEST(FramesCsv, EveryRowHasAllColumns) {
  std::istringstream text(framesCsv(smallRun(true)));
  std::string line;
  std::vector<std::ptrdiff_t> commas;
  while (std::getline(text, line)) {
    commas.push_back(std::count(line.begin(), line.end(), ','));
  }
  ASSERT_EQ(commas.size(), 3U);
  EXPECT_EQ(commas[1], commas[0]);
  EXPECT_EQ(commas[2], commas[0]);
}

TEST(FramesCsv, LeavesUnknownCovarianceEmpty) {
  EXPECT_THAT(framesCsv(smallRun(true)), HasSubstr(",1,,,,,,,0.25,8,3,"));
  EXPECT_THAT(framesCsv(smallRun(true)), Not(HasSubstr("nan")));
}

TEST(Base64, MatchesTheStandardsVectors) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(ReportPage, NeedsNoOtherFile) {
  ReportPage page;
  page.title = "a <b> & c";
  page.table = {{"method"}, {"edges"}};
  page.charts = {{"x [m]", {"x"}, {0.0, 0.1}, {{1.0, std::numeric_limits<double>::quiet_NaN()}}}};
  page.pictures = {{"first", "bytes"}};
  const std::string html = reportHtml(page);
  EXPECT_THAT(html, HasSubstr("a &lt;b&gt; &amp; c"));
  EXPECT_THAT(html, HasSubstr("[[0.0,1.0],[0.1,null]]"));
  EXPECT_THAT(html, HasSubstr("data:image/png;base64,Ynl0ZXM="));
  EXPECT_THAT(html, HasSubstr("Dygraph="));
  EXPECT_THAT(html, Not(HasSubstr("<link")));
  EXPECT_THAT(html, Not(HasSubstr("<script src")));
}

TEST(Overlay, IsAPngOfTheModelsPlace) {
  Snapshot snapshot;
  snapshot.left.camera = {100, 100, 50, 40, 100, 80, Pose::Identity()};
  snapshot.left.window = {0, 0, 100, 80};
  snapshot.left.image = GrayImage(100, 80, 60);
  snapshot.fix.c1Mo = makePoseThetaU({0, 0, 1}, {0, 0, 0});
  snapshot.view.cameras.resize(1);
  snapshot.view.cameras[0].edges = {{{-0.1, 0, 0}, {0.1, 0, 0}, {50, 40}, 0.3}};
  const std::string png = overlayPng(snapshot, 960);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  // Width and height stand big-endian in the header chunk.
  EXPECT_EQ(static_cast<unsigned char>(png.at(19)), 100);
  EXPECT_EQ(static_cast<unsigned char>(png.at(23)), 80);
  EXPECT_EQ(static_cast<unsigned char>(overlayPng(snapshot, 50).at(19)), 50);
}

}  // namespace
}  // namespace ringhook
