#include "tracking/edge_tracker.h"
#include "core/angle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "../../support/scratch_folder.h"
#include "core/error.h"
#include "tests/unit/tracking/painted_hook.h"
#include "tests/unit/tracking/visp_data.h"
#include "tracking/edge_site.h"
#include "tracking/hook_search.h"
#include "tracking/plate_pose.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using test::numbered;
using test::readPgm;
using test::vispData;

RectifiedFrame monoFrame(const PinholeView& camera, GrayImage image, int number) {
  RectifiedFrame frame;
  frame.time = Time::fromSeconds(0.02 * number);
  const Window whole{0, 0, image.width, image.height};
  frame.views.push_back({camera, whole, std::move(image)});
  return frame;
}

double degrees(double radians) { return radians / kDegree; }

TEST(EdgeTracker, FollowsVispsCubeThroughTheWholeSequence) {
  const fs::path folder = vispData() / "mbt/cube";
  if (!fs::exists(folder)) {
    GTEST_SKIP() << "visp-images-data is not installed";
  }
  EdgeTrackerOptions options = loadEdgeSettings(vispData() / "mbt/cube.xml");
  options.sample_step_px = 2.0;  // with the file's 4 px ViSP slides off the cube in the last frames
  const PinholeView camera{547.7367575, 542.0744058, 338.7036994, 234.5083345, 640, 480};
  std::ifstream file(vispData() / "mbt/cube.0.pos");
  std::array<double, 6> p{};
  for (double& value : p) {
    file >> value;
  }
  ASSERT_TRUE(file);
  EdgeTracker tracker(vispData() / "mbt/cube.cao", options);
  std::optional<Pose> start = makePoseThetaU({p[0], p[1], p[2]}, {p[3], p[4], p[5]});
  int tracked = 0;
  for (int n = 0; n < 218; ++n) {
    const auto frame = monoFrame(camera, readPgm(numbered(folder, "image", 4, n, ".pgm")), n);
    const auto seen = tracker.track(frame, start);
    ASSERT_TRUE(seen) << "frame " << n << ": " << seen.reason();
    EXPECT_LT(tracker.quality().spread_px, 2.0);
    start.reset();
    ++tracked;
  }
  EXPECT_EQ(tracked, 218);
}

Pose castlePose(int n) {
  std::ifstream file(
      numbered(vispData() / "mbt-depth/Castle-simu/CameraPose", "Camera_", 3, n, ".txt"));
  Pose cMo = Pose::Identity();
  for (int i = 0; i < 16; ++i) {
    file >> cMo.matrix()(i / 4, i % 4);
  }
  return cMo;
}

TEST(EdgeTracker, StaysWithinVispsOwnLimitsOnTheSimulatedCastle) {
  const fs::path folder = vispData() / "mbt-depth/Castle-simu";
  if (!fs::exists(folder)) {
    GTEST_SKIP() << "visp-images-data is not installed";
  }
  const EdgeTrackerOptions options = loadEdgeSettings(folder / "Config/chateau.xml");
  const PinholeView camera{700.0, 700.0, 320.0, 240.0, 640, 480};
  Pose oMcube = Pose::Identity();
  oMcube.matrix() << -1, 0, 0, -0.2, 0, 0, 1, 0.12, 0, 1, 0, -0.15, 0, 0, 0, 1;
  EdgeTracker tracker(
      {{folder / "Models/chateau.cao", Pose::Identity()}, {folder / "Models/cube.cao", oMcube}},
      options);
  std::optional<Pose> start = castlePose(1);
  double worst_mm = 0.0;
  double worst_deg = 0.0;
  double sum_mm = 0.0;
  int n = 1;
  for (; fs::exists(numbered(folder / "CameraPose", "Camera_", 3, n, ".txt")) &&
         fs::exists(numbered(folder / "Images", "Image_", 4, n, ".pgm"));
       ++n) {
    auto image = readPgm(numbered(folder / "Images", "Image_", 4, n, ".pgm"));
    const auto seen = tracker.track(monoFrame(camera, std::move(image), n), start);
    ASSERT_TRUE(seen) << "frame " << n << ": " << seen.reason();
    const Pose error = castlePose(n).inverse() * seen->c1Mo_start;
    const double mm = 1e3 * (castlePose(n).translation() - seen->c1Mo_start.translation()).norm();
    sum_mm += mm;
    worst_mm = std::max(worst_mm, mm);
    worst_deg = std::max(worst_deg, degrees(thetaU(error.linear()).norm()));
    start.reset();
  }
  RecordProperty("worst_mm", std::to_string(worst_mm));
  RecordProperty("mean_mm", std::to_string(sum_mm / (n - 1)));
  EXPECT_GE(n, 33);
  EXPECT_LE(worst_mm, 7.0);
  EXPECT_LE(worst_deg, 3.7);
}

RectifiedFrame hookFrame(const Pose& c1Mo, int number) {
  RectifiedFrame frame = test::emptyPair(90);
  frame.time = Time::fromSeconds(0.02 * number);
  test::cutWindows(frame, c1Mo * Eigen::Vector3d(0.0, 0.0, 0.1), 500, 900);
  test::paintHook(frame, c1Mo, 170.0, 215.0);
  std::mt19937 random(static_cast<unsigned>(number));
  for (RectifiedView& view : frame.views) {
    test::addNoise(view.image, 2.0, random);
  }
  return frame;
}

/// A hook that swings by 3 degrees on a belt of 0.05 m/s, 50 frames a second.
Pose swingingPose(int number) {
  const double t = 0.02 * number;
  const double swing = 0.052 * std::sin(4.7 * t);
  return test::pairPose().inverse() * hookAt(SearchSpace{}, -0.1 + 0.05 * t, swing, 0.3 * swing);
}

TEST(EdgeTracker, FollowsASwingingHookInTwoMovingWindowsWithinAMillimetre) {
  EdgeTracker tracker(test::hookModelPath());
  double worst_m = 0.0;
  for (int n = 0; n < 20; ++n) {
    const Pose c1Mo = swingingPose(n);
    const Pose predicted = c1Mo * expSe3((Twist() << 0, 5e-4, 5e-4, 2e-3, 0, 0).finished());
    const auto seen = tracker.track(hookFrame(c1Mo, n), predicted);
    ASSERT_TRUE(seen) << "frame " << n << ": " << seen.reason();
    ASSERT_EQ(seen->cameras.size(), 2U);
    worst_m = std::max(worst_m, (seen->c1Mo_start.translation() - c1Mo.translation()).norm());
    std::vector<double> residuals;
    for (const EdgeFeature& edge : seen->cameras[0].edges) {
      const auto line = projectEdge(seen->cameras[0].camera, c1Mo, edge.start_o, edge.end_o);
      ASSERT_TRUE(line);
      residuals.push_back(line->distance(edge.pixel));
    }
    EXPECT_LT(robustSigma(residuals), 0.3);
  }
  RecordProperty("worst_mm", std::to_string(1e3 * worst_m));
  EXPECT_LT(worst_m, 1e-3);
}

TEST(EdgeTracker, RefusesWithoutAStartAndForgetsThePoseWhenTheHookIsGone) {
  EdgeTracker tracker(test::hookModelPath());
  const RectifiedFrame frame = hookFrame(swingingPose(0), 0);
  const auto none = tracker.track(frame, std::nullopt);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.reason(), "no start pose");
  ASSERT_TRUE(tracker.track(frame, swingingPose(0)));
  ASSERT_TRUE(tracker.track(frame, std::nullopt)) << "keeps its own last pose";
  RectifiedFrame gone = frame;
  std::mt19937 random(1);
  for (RectifiedView& view : gone.views) {
    std::fill(view.image.pixels.begin(), view.image.pixels.end(), std::uint8_t{90});
    test::addNoise(view.image, 2.0, random);
  }
  EXPECT_FALSE(tracker.track(gone, swingingPose(0)));
  const auto after = tracker.track(frame, std::nullopt);
  ASSERT_FALSE(after);
  EXPECT_EQ(after.reason(), "no start pose");
  EXPECT_TRUE(tracker.track(frame, swingingPose(0)));
}

TEST(EdgeTracker, NamesTheModelThatIsMissingOrEmpty) {
  EXPECT_THROW(EdgeTracker("absent.cao"), InputError);
  const ScratchFolder folder;
  const fs::path empty = folder.write("ringhook_empty.cao", "V1\n1\n0 0 0\n0\n0\n0\n0\n0\n");
  try {
    EdgeTracker tracker(empty);
    FAIL() << "a model without faces was accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("model with no face"));
    EXPECT_THAT(e.what(), testing::HasSubstr("ringhook_empty.cao"));
  }
  EXPECT_THROW(loadEdgeSettings("absent.xml"), InputError);
}

TEST(EdgeSite, PlacesASlantedPaintedEdgeWithinATwentiethOfAPixel) {
  RectifiedFrame frame = test::emptyPair(60);
  test::cutWindows(frame, Eigen::Vector3d(0.0, 0.0, 1.3), 200, 200);
  const Pose c1Mplane = makePoseThetaU({0.0, 0.0, 1.3}, {0.0, 0.0, 0.3});
  test::paint(frame.views[0], c1Mplane, {0.03, 0.03},
              test::polygon({{-0.02, -0.02}, {0.02, -0.02}, {0.02, 0.02}, {-0.02, 0.02}}, 180.0));
  const auto line =
      projectEdge(frame.views[0].camera, c1Mplane, {-0.02, -0.02, 0}, {0.02, -0.02, 0});
  ASSERT_TRUE(line);
  for (double x = -0.015; x < 0.015; x += 0.001) {
    const auto on = frame.views[0].camera.project(c1Mplane * Eigen::Vector3d(x, -0.02, 0));
    const Eigen::Vector2d beside = on.value().array().round();
    const auto fine =
        refineAcross(frame.views[0].image, frame.views[0].window, beside, line->normal, 3, 2.0);
    ASSERT_TRUE(fine);
    EXPECT_NEAR(line->distance(fine->pixel), 0.0, 0.05);
    EXPECT_LT(fine->direction, 0.1);
  }
}

}  // namespace
}  // namespace ringhook
