#include "tracking/marker_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "tests/unit/tracking/painted_hook.h"
#include "tracking/hook_search.h"
#include "tracking/plate_pose.h"

namespace ringhook {
namespace {

using test::emptyPair;
using test::pairPose;

struct CornerErrors {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double rms_per_axis = 0.0;
  int corners = 0;
};

/// Against the projection of the corners under the pose that was painted.
CornerErrors cornerErrors(const HookView& seen, const Pose& c1Mo) {
  CornerErrors errors;
  double squares = 0.0;
  for (const CameraFeatures& camera : seen.cameras) {
    for (const CornerFeature& corner : camera.corners) {
      const Eigen::Vector2d d = corner.pixel - camera.camera.project(c1Mo * corner.point_o).value();
      errors.mean += d;
      squares += d.squaredNorm();
      ++errors.corners;
    }
  }
  errors.mean /= errors.corners;
  errors.rms_per_axis = std::sqrt(squares / (2.0 * errors.corners));
  return errors;
}

RectifiedFrame taggedFrame(const TagPlate& plate, const Pose& c1Mo, unsigned seed) {
  RectifiedFrame frame = emptyPair(90);
  test::paintHook(frame, c1Mo, 170.0, 210.0);
  test::paintTags(frame, plate, c1Mo);
  std::mt19937 random(seed);
  for (RectifiedView& view : frame.views) {
    test::addNoise(view.image, 2.0, random);
  }
  return frame;
}

Pose somePose(double travel, double angle_x, double angle_y) {
  return pairPose().inverse() * hookAt(SearchSpace{}, travel, angle_x, angle_y);
}

TEST(MarkerTracker, FindsPaintedCornersWithinATenthOfAPixelWithoutBias) {
  const TagPlate plate = loadTagPlate(test::hookPlatePath());
  MarkerTracker tracker(plate);
  for (const double angle : {-0.15, 0.02, 0.12}) {
    const Pose c1Mo = somePose(0.05, angle, 0.5 * angle);
    RectifiedFrame frame = taggedFrame(plate, c1Mo, 7);
    test::cutWindows(frame, c1Mo * Eigen::Vector3d(0, -0.035, 0.2), 400, 500);
    const auto seen = tracker.track(frame, std::nullopt);
    ASSERT_TRUE(seen) << seen.reason();
    const CornerErrors errors = cornerErrors(*seen, c1Mo);
    EXPECT_EQ(errors.corners, 16);
    EXPECT_LT(errors.rms_per_axis, 0.08);
    EXPECT_LT(errors.mean.cwiseAbs().maxCoeff(), 0.04);
    EXPECT_LT((seen->c1Mo_start.translation() - c1Mo.translation()).norm(), 1e-3);
  }
}

TEST(MarkerTracker, LosesHalfItsAccuracyWhereTagSidesFollowPixelRowsButNotItsPose) {
  const TagPlate plate = loadTagPlate(test::hookPlatePath());
  const Pose c1Mo = somePose(0.05, 0.0, 0.0);
  RectifiedFrame frame = taggedFrame(plate, c1Mo, 7);
  test::cutWindows(frame, c1Mo * Eigen::Vector3d(0, -0.035, 0.2), 400, 500);
  const auto seen = MarkerTracker(plate).track(frame, std::nullopt);
  ASSERT_TRUE(seen) << seen.reason();
  EXPECT_LT(cornerErrors(*seen, c1Mo).rms_per_axis, 0.2);
  EXPECT_LT((seen->c1Mo_start.translation() - c1Mo.translation()).norm(), 1e-3);
}

TEST(MarkerTracker, IsAsExactInTheFullImageAsInAWindow) {
  const TagPlate plate = loadTagPlate(test::hookPlatePath());
  const Pose c1Mo = somePose(-0.1, 0.1, 0.05);
  const RectifiedFrame frame = taggedFrame(plate, c1Mo, 11);
  const auto seen = MarkerTracker(plate).track(frame, std::nullopt);
  ASSERT_TRUE(seen) << seen.reason();
  const CornerErrors errors = cornerErrors(*seen, c1Mo);
  EXPECT_EQ(errors.corners, 16);
  EXPECT_LT(errors.rms_per_axis, 0.08);
}

TEST(MarkerTracker, IgnoresTagsThatAreNotOnThePlate) {
  const TagPlate painted = loadTagPlate(test::hookPlatePath());
  TagPlate other = painted;
  other.tags[0].id = 100;
  other.tags[1].id = 101;
  const RectifiedFrame frame = taggedFrame(painted, somePose(0.0, 0.0, 0.0), 3);
  const auto seen = MarkerTracker(other).track(frame, std::nullopt);
  ASSERT_FALSE(seen);
  EXPECT_EQ(seen.reason(), "no tag seen");
}

TEST(MarkerTracker, RefusesTagsThatCannotBeOnePlate) {
  const TagPlate painted = loadTagPlate(test::hookPlatePath());
  TagPlate swapped = painted;
  std::swap(swapped.tags[0].id, swapped.tags[1].id);
  const RectifiedFrame frame = taggedFrame(painted, somePose(0.0, 0.0, 0.0), 3);
  const auto seen = MarkerTracker(swapped).track(frame, std::nullopt);
  ASSERT_FALSE(seen);
  EXPECT_EQ(seen.reason(), "tags contradict each other");
}

/// Exact corners of a plate plus Gaussian noise.
std::vector<CameraFeatures> noisyCorners(const TagPlate& plate, const Pose& c1Mo, std::size_t views,
                                         double sigma_px, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, sigma_px);
  std::vector<CameraFeatures> cameras;
  const RectifiedFrame frame = emptyPair(0);
  for (std::size_t c = 0; c < views; ++c) {
    CameraFeatures seen;
    seen.camera = frame.views[c].camera;
    for (const PlateTag& tag : plate.tags) {
      for (const Eigen::Vector3d& p : tagCorners(plate, tag)) {
        const Eigen::Vector2d pixel = seen.camera.project(c1Mo * p).value();
        seen.corners.push_back({p, pixel + Eigen::Vector2d(noise(random), noise(random)), 0.1});
      }
    }
    cameras.push_back(seen);
  }
  return cameras;
}

TEST(PlatePose, NeverTakesTheFlippedPoseWithTwoViews) {
  const TagPlate plate = loadTagPlate(test::hookPlatePath());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-0.26, 0.26);
  for (int trial = 0; trial < 100; ++trial) {
    const Pose c1Mo = somePose(0.1, angle(random), angle(random));
    const auto cameras = noisyCorners(plate, c1Mo, 2, 0.1, random);
    const auto start = startPose(cameras, std::nullopt);
    ASSERT_TRUE(start);
    EXPECT_LT(thetaU(c1Mo.linear().transpose() * start->linear()).norm(), 0.02);
  }
}

TEST(PlatePose, LetsThePredictionDecideWhereOneViewCannot) {
  TagPlate plate = loadTagPlate(test::hookPlatePath());
  plate.tags.resize(1);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> angle(-0.1, 0.1);
  for (int trial = 0; trial < 50; ++trial) {
    const Pose c1Mo = somePose(0.0, angle(random), angle(random));
    const auto cameras = noisyCorners(plate, c1Mo, 1, 0.05, random);
    const Pose predicted = c1Mo * expSe3((Twist() << 1e-3, 0, 1e-3, 0.01, 0.01, 0).finished());
    const auto start = startPose(cameras, predicted);
    ASSERT_TRUE(start);
    EXPECT_LT(thetaU(c1Mo.linear().transpose() * start->linear()).norm(), 0.15);
  }
}

}  // namespace
}  // namespace ringhook
