#include "tracking/hook_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/tracking/painted_hook.h"

namespace ringhook {
namespace {

using test::emptyPair;
using test::pairPose;

/// Random bright and dark quadrangles behind the hook.
void paintClutter(RectifiedFrame& frame, int pieces, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-0.4, 0.4);
  std::uniform_real_distribution<double> side(-0.06, 0.06);
  std::uniform_real_distribution<double> grey(30.0, 220.0);
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector2d centre(place(random), place(random));
    std::vector<Eigen::Vector2d> corners;
    for (int k = 0; k < 4; ++k) {
      corners.emplace_back(side(random), side(random));
    }
    const auto figure = test::polygon(corners, grey(random));
    Pose fMplane = Pose::Identity();
    fMplane.linear() = test::planeInHook(0.0).linear();
    fMplane.translation() = Eigen::Vector3d(0.1, centre.x(), 0.7 + centre.y());
    for (RectifiedView& view : frame.views) {
      test::paint(view, pairPose().inverse() * fMplane, {0.06, 0.06}, figure);
    }
  }
}

SearchSpace searchSpace() {
  SearchSpace space;
  space.fMc1 = pairPose();
  return space;
}

/// Largest distance of a model point's image from where it should be [px].
double worstPixel(const RectifiedFrame& frame, const EdgeModel& model, const Pose& a,
                  const Pose& b) {
  double worst = 0.0;
  for (const RectifiedView& view : frame.views) {
    for (const Eigen::Vector3d& p : model.points) {
      worst = std::max(
          worst, (view.camera.project(a * p).value() - view.camera.project(b * p).value()).norm());
    }
  }
  return worst;
}

RectifiedFrame scene(const Pose* fMo, int clutter, unsigned seed) {
  RectifiedFrame frame = emptyPair(90);
  std::mt19937 random(seed);
  paintClutter(frame, clutter, random);
  if (fMo != nullptr) {
    test::paintHook(frame, pairPose().inverse() * *fMo, 170.0, 215.0);
  }
  for (RectifiedView& view : frame.views) {
    test::addNoise(view.image, 2.0, random);
  }
  return frame;
}

TEST(HookSearch, FindsThePaintedHookWithinReachOfTheEdgeTracker) {
  const EdgeModel model = loadEdgeModel(test::hookModelPath());
  const SearchSpace space = searchSpace();
  const std::vector<Eigen::Vector3d> places{{-0.213, 0.14, -0.05}, {0.171, -0.2, 0.1}};
  for (const Eigen::Vector3d& p : places) {
    const Pose fMo = hookAt(space, p.x(), p.y(), p.z());
    const RectifiedFrame frame = scene(&fMo, 12, 42);
    const auto found = findHook(frame, model, space);
    ASSERT_TRUE(found) << found.reason();
    EXPECT_LT(worstPixel(frame, model, *found, pairPose().inverse() * fMo), 5.0);
  }
}

// Trackers lock 7 mm off, on the tags' white border, if the search leaves such a difference.
TEST(HookSearch, FindsAHookThatHangsHigherOrLowerThanItsModelSays) {
  const EdgeModel model = loadEdgeModel(test::hookModelPath());
  const SearchSpace space = searchSpace();
  for (const double longer : {-0.009, 0.009}) {
    const Pose fMo = hookAt(space, 0.05, 0.04, -0.03, longer);
    const RectifiedFrame frame = scene(&fMo, 12, 7);
    const Outcome<Pose> found = findHook(frame, model, space);
    ASSERT_TRUE(found) << found.reason();
    EXPECT_LT(worstPixel(frame, model, *found, pairPose().inverse() * fMo), 5.0);
  }
}

TEST(HookSearch, RefusesClutterWithoutAHook) {
  const EdgeModel model = loadEdgeModel(test::hookModelPath());
  const auto found = findHook(scene(nullptr, 40, 9), model, searchSpace());
  ASSERT_FALSE(found);
  EXPECT_EQ(found.reason(), "no hook found");
}

TEST(HookSearch, RefusesToChooseBetweenTwoHooksUnlessTheRangeDoes) {
  const EdgeModel model = loadEdgeModel(test::hookModelPath());
  SearchSpace space = searchSpace();
  const Pose first = hookAt(space, -0.2, 0.05, 0.0);
  RectifiedFrame frame = scene(&first, 0, 1);
  const Pose second = hookAt(space, 0.2, -0.05, 0.0);
  test::paintHook(frame, pairPose().inverse() * second, 170.0, 215.0);
  const auto both = findHook(frame, model, space);
  ASSERT_FALSE(both);
  EXPECT_EQ(both.reason(), "two places look like the hook");
  space.travel_from_m = 0.1;
  const auto one = findHook(frame, model, space);
  ASSERT_TRUE(one) << one.reason();
  EXPECT_LT(worstPixel(frame, model, *one, pairPose().inverse() * second), 5.0);
}

}  // namespace
}  // namespace ringhook
