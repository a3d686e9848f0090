// Published real images of a tag on a robot's flange (ViSP's hand-eye example), where they are at
// hand: environment variable RINGHOOK_DATA, or ../shared/data beside the sources.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "calib/solve/plate_images.h"
#include "camera/replay_camera.h"
#include "core/angle.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

// As published with the images: ViSP's calibration of the camera, k1 = kud.
StereoRig publishedRig() {
  StereoRig rig;
  rig.left.width = 640;
  rig.left.height = 480;
  rig.left.K << 601.0670294, 0, 321.3921431, 0, 602.4186662, 236.8025954, 0, 0, 1;
  rig.left.distortion = Eigen::Vector4d(0.05663697965, 0, 0, 0);
  return rig;
}

TagPlate publishedTag() {
  TagPlate plate;
  plate.tags = {{10, 0.048, Pose::Identity()}};
  return plate;
}

TEST(FrankaSet, AgreesWithThePublishedPoseAndLeavesLess) {
  const char* data = std::getenv("RINGHOOK_DATA");
  const fs::path root =
      data != nullptr ? fs::path(data) : fs::path(RINGHOOK_SOURCE_DIR) / ".." / "shared" / "data";
  const fs::path folder = root / "franka-eye-to-hand";
  if (!fs::exists(folder)) {
    GTEST_SKIP() << folder << " is not here: the published images are not part of the project";
  }
  PlateImages images;
  images.left = filesMatching((folder / "franka_image-*.png").string());
  images.poses = filesMatching((folder / "franka_pose_rPe_*.yaml").string());
  const StepHook quiet = [](double, const std::string&) {};
  const FoundPlates found = findPlates(images, publishedRig(), publishedTag(), quiet);
  ASSERT_EQ(found.views.size(), 8U);
  const PlateCalibration c =
      calibrateFromViews(found.views, EyeSetup::kEyeToHand, ZeroChoice::kWherePaying, quiet);
  const Pose published =
      makePoseThetaU({0.9540358, -0.0512357, 0.4762201}, {-1.1041081, -1.1127456, 1.2895409});
  const Pose& fMc1 = c.result.pose.camera;
  const double angle = thetaU(fMc1.linear().transpose() * published.linear()).norm();
  EXPECT_LT(1e3 * (fMc1.translation() - published.translation()).norm(), 1.0);
  EXPECT_LT(angle / kDegree, 0.1);
  EXPECT_LT(1e3 * c.result.residual.translation_m, 1.8);
  EXPECT_LT(c.result.residual.rotation_rad / kDegree, 0.51);
  // The lens model that came with the pictures is off by more than their corners scatter: pairs
  // left out refute the covariances that follow from the scatter alone.
  EXPECT_TRUE(weightsRefuted(c.result));
  const WeighedFit& believed = c.result.weighings.at(0);
  EXPECT_EQ(believed.weights, PairWeights::kViews);
  EXPECT_LT(c.result.heldout.translation_m, 0.97 * believed.left_out.rms.translation_m);
  EXPECT_LT(c.result.heldout.rotation_rad, 0.85 * believed.left_out.rms.rotation_rad);
  EXPECT_EQ(c.result.verdict.grade, Grade::kPoor) << c.result.verdict.sentence;
}

}  // namespace
}  // namespace ringhook
