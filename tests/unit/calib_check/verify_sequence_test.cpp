// A stored sequence of the simulated cell, whose rig is true: the verdict is ok, and it is not for
// the same pictures with a rig that is turned.

#include <gtest/gtest.h>

#include <filesystem>

#include "calib/solve/verify_views.h"
#include "core/angle.h"
#include "core/error.h"

namespace ringhook {
namespace {

const std::filesystem::path kClip =
    std::filesystem::path(RINGHOOK_SOURCE_DIR) / "datasets/clips/swing-marker";

std::vector<SightedView> sight(const StereoRig& rig, std::size_t most) {
  return sightPlate(openSequence(kClip), rig, loadTagPlate(kClip / "marker.yaml"), most,
                    [](double, const std::string&) {});
}

TEST(VerifySequence, HoldsTheRigThatTookItAndMeasuresTheTagsDistance) {
  const StereoRig rig = loadRig(kClip / "rig.yaml");
  VerifyOptions options;
  options.bar = barBetween(loadTagPlate(kClip / "marker.yaml"), 0, 1);
  EXPECT_NEAR(options.bar->known_m, 0.054, 1e-12);
  const std::vector<SightedView> views = sight(rig, 12);
  ASSERT_EQ(views.size(), 12U);
  const Verification v = verifyRig(rig, views, options);
  EXPECT_EQ(v.state, RigState::kOk);
  EXPECT_EQ(v.bar.count, 12);
  EXPECT_LT(v.bar.rms_m, 0.05e-3);
  EXPECT_LT(v.rows.rms_px, 0.15);
}

TEST(VerifySequence, FindsARigTurnedAboutX) {
  StereoRig rig = loadRig(kClip / "rig.yaml");
  const double turn = 0.05 * kDegree;
  rig.c2Mc1 = makePoseThetaU({0, 0, 0}, {turn, 0, 0}) * rig.c2Mc1;
  const Verification v = verifyRig(rig, sight(rig, 12));
  EXPECT_EQ(v.state, RigState::kMoved);
  EXPECT_NEAR(v.rows.rms_px, rig.left.K(0, 0) * turn, 0.1 * rig.left.K(0, 0) * turn);
}

TEST(VerifySequence, RefusesAnotherSizeOfImagesAndUnknownTags) {
  StereoRig rig = loadRig(kClip / "rig.yaml");
  rig.left.width = rig.right->width = 300;
  EXPECT_THROW(static_cast<void>(sight(rig, 1)), InputError);
  EXPECT_THROW(static_cast<void>(barBetween(loadTagPlate(kClip / "marker.yaml"), 0, 9)),
               InputError);
  EXPECT_THROW(static_cast<void>(barBetween(loadTagPlate(kClip / "marker.yaml"), 1, 1)),
               InputError);
}

}  // namespace
}  // namespace ringhook
