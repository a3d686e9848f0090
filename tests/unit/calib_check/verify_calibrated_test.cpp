// A rig that was calibrated from noisy views is not the true one: its own doubt must not be taken
// for a change.

#include <gtest/gtest.h>

#include "calib/solve/verify.h"
#include "calib_check/verify_scene.h"
#include "core/angle.h"

namespace ringhook {
namespace {

/// The true rig as a calibration from 25 views with noise finds it.
StereoRig calibrated(std::uint64_t seed) {
  const Board board = parseBoard("chessboard:9x6:30mm");
  StereoSolution start;
  start.rig = acceptedRig();
  std::vector<StereoView> views;
  const std::vector<SightedView> sighted = viewsBy(acceptedRig(), 25, 0.05, seed, 0.25);
  for (const SightedView& seen : sighted) {
    StereoView view{seen.name, seen.name, start.rig.left.width, start.rig.left.height, {}, {}};
    for (int i = 0; i < 54; ++i) {
      view.left.ids.push_back(i);
    }
    view.right.ids = view.left.ids;
    view.left.pixels = seen.left_px;
    view.right.pixels = seen.right_px;
    views.push_back(view);
  }
  start.c1Mt = startFit(acceptedRig(), sighted).c1Mt;
  const StereoSolution found = refineSolution(start, views, board, FitOptions{});
  StereoRig rig = found.rig;
  rig.rms_px = rms(viewErrors(found, views, board));
  rig.heldout_vertical_disparity_px = rig.rms_px;
  rig.views = 25;
  return rig;
}

TEST(VerifyCalibrated, RaisesHardlyAnyFalseAlarm) {
  int alarms = 0;
  double chi_square = 0.0;
  const int rigs = 20;
  for (std::uint64_t seed = 1; seed <= rigs; ++seed) {
    const StereoRig rig = calibrated(seed);
    for (const int count : {6, 20}) {
      const Verification v =
          verifyRig(rig, viewsBy(acceptedRig(), count, 0.05, 1000 + 7 * seed + count));
      alarms += v.state != RigState::kOk;
      chi_square += v.moved.chi_square / (2 * rigs);
    }
  }
  RecordProperty("false_alarms_of_40", alarms);
  EXPECT_LE(alarms, 1);
  EXPECT_LT(chi_square, 12.0);  // of six degrees of freedom: the doubt is allowed for
}

TEST(VerifyCalibrated, StillFindsTwoHundredthsOfADegree) {
  constexpr double kTurn = 0.02 * kDegree;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const StereoRig rig = calibrated(seed);
    for (int axis = 0; axis < 3; ++axis) {
      const StereoRig moved = movedRig(kTurn * Eigen::Vector3d::Unit(axis), {0, 0, 0});
      const Verification v = verifyRig(rig, viewsBy(moved, 8, 0.05, 500 + seed));
      EXPECT_EQ(v.state, RigState::kMoved) << seed << axis;
    }
  }
}

}  // namespace
}  // namespace ringhook
