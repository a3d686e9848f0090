// The calibration board in someone's hands: where it is held it looks as one that was always there,
// and taken away it leaves neither its picture nor its shadow behind.

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "scene_view.h"
#include "sim/nominal_rig.h"
#include "sim/sim_stereo_camera.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;

/// Facing the cameras, turned a little, its middle at `middle_f` [m].
Pose facing(const Vector3d& middle_f) {
  Pose fMt = Pose::Identity();
  fMt.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  fMt.linear() = Eigen::AngleAxisd(0.2, Vector3d(0.3, 0.5, 1.0).normalized()) * fMt.linear();
  fMt.translation() = middle_f - fMt.linear() * Vector3d(4 * 0.03, 2.5 * 0.03, 0);
  return fMt;
}

CellOptions cellWithBoard(const Pose& fMt) {
  CellOptions options = hookInView(-0.1);
  options.scene.board = {9, 6, 0.03, fMt};
  return options;
}

SimCameraOptions slowCamera() {
  SimCameraOptions options;
  options.rate_hz = 10.0;
  return options;
}

TEST(HeldBoard, LooksAsOneThatWasAlwaysThere) {
  const Pose there = facing({0.60, 0.05, 0.75});
  CellWorld always(cellWithBoard(there));
  CellWorld held(cellWithBoard(facing({0.5, -0.1, 0.6})));
  SimStereoCamera one(always, nominalRig(), slowCamera());
  SimStereoCamera two(held, nominalRig(), slowCamera());
  held.advanceTo(Time::fromSeconds(0.05));  // after the first exposure
  held.holdBoard(there);
  const StereoFrame a = frameAt(always, one, 0.12);
  const StereoFrame b = frameAt(held, two, 0.12);
  ASSERT_EQ(a.index, 1U);
  EXPECT_TRUE(a.left.pixels == b.left.pixels);
  EXPECT_TRUE(a.right.pixels == b.right.pixels);
}

TEST(HeldBoard, TakenAwayLeavesNeitherPictureNorShadow) {
  CellWorld without(hookInView(-0.1));
  CellWorld with(cellWithBoard(facing({0.60, 0.05, 0.75})));
  SimStereoCamera one(without, nominalRig(), slowCamera());
  SimStereoCamera two(with, nominalRig(), slowCamera());
  with.advanceTo(Time::fromSeconds(0.05));
  with.holdBoard(std::nullopt);
  const StereoFrame a = frameAt(without, one, 0.12);
  const StereoFrame b = frameAt(with, two, 0.12);
  EXPECT_TRUE(a.left.pixels == b.left.pixels);
  EXPECT_TRUE(a.right.pixels == b.right.pixels);
}

TEST(HeldBoard, TouchesNothing) {
  CellWorld without(hookInView(-0.1));
  CellWorld with(cellWithBoard(facing({0.60, 0.05, 0.75})));
  for (int i = 1; i <= 20; ++i) {
    with.holdBoard(facing({0.42, -0.1 + 0.01 * i, 0.65}));  // through the hook
    without.advanceTo(Time::fromSeconds(0.02 * i));
    with.advanceTo(Time::fromSeconds(0.02 * i));
  }
  EXPECT_TRUE(truth(without).hooks[0].fMo.matrix() == truth(with).hooks[0].fMo.matrix());
}

TEST(HeldBoard, RefusesACellWithoutBoardAndAPoseThatIsNone) {
  CellWorld without(hookInView(-0.1));
  EXPECT_THROW(without.holdBoard(Pose::Identity()), Error);
  CellWorld with(cellWithBoard(Pose::Identity()));
  Pose nowhere = Pose::Identity();
  nowhere.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(with.holdBoard(nowhere), Error);
}

}  // namespace
}  // namespace ringhook
