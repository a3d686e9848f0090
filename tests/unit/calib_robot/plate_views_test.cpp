// Calibration on the corners of a plate in two cameras, against made-up truth.

#include "calib/solve/plate_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "pair_scene.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;

struct MadeViews {
  HandEye truth;
  std::vector<PlateView> views;
};

// Two cameras 0.4 m apart, a plate of two 32 mm tags at 1 m, corner noise 0.05 px.
MadeViews madeViews(unsigned seed, bool stereo, double arm_m, double arm_rad) {
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  PairScene scene;
  scene.translation_m = scene.rotation_rad = 0.0;
  const MadePairs pairs = makePairs(scene, dice);
  MadeViews made{pairs.truth, {}};
  for (const PosePair& pair : pairs.pairs) {
    PlateView view{pair.name, pair.fMe, {}};
    Twist d;
    for (int i = 0; i < 6; ++i) {
      d[i] = (i < 3 ? arm_m : arm_rad) * normal(dice);
    }
    const Pose c1Mt = pair.cMt * expSe3(d);
    for (int side = 0; side < (stereo ? 2 : 1); ++side) {
      CameraFeatures seen;
      seen.camera = {2500,
                     2500,
                     1023,
                     1023,
                     2048,
                     2048,
                     makePoseThetaU(Vector3d(-0.4 * side, 0, 0), Vector3d(0, 0.3 * side, 0))};
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3d point(corner % 4 == 1 || corner % 4 == 2 ? 0.016 : -0.016,
                             (corner < 4 ? -0.022 : 0.022) + (corner % 4 > 1 ? 0.016 : -0.016), 0);
        const Eigen::Vector2d noise(normal(dice), normal(dice));
        seen.corners.push_back({point, *seen.camera.project(c1Mt * point) + 0.05 * noise, 0.1});
      }
      view.seen.cameras.push_back(seen);
    }
    view.seen.c1Mo_start = c1Mt;
    made.views.push_back(view);
  }
  return made;
}

PlateCalibration calibrate(const std::vector<PlateView>& views) {
  return calibrateFromViews(views, EyeSetup::kEyeToHand, ZeroChoice::kKeep,
                            [](double, const std::string&) {});
}

double cameraError(const PlateCalibration& c, const MadeViews& made) {
  return (c.result.pose.camera.translation() - made.truth.camera.translation()).norm();
}

TEST(PlateViews, FindCameraPlateAndBothNoises) {
  const MadeViews made = madeViews(3, true, 0.0002, 0.0005);
  const PlateCalibration c = calibrate(made.views);
  EXPECT_NE(c.result.verdict.grade, Grade::kPoor) << c.result.verdict.sentence;
  EXPECT_LT(cameraError(c, made), 4.0 * c.result.sigmas->camera_m);
  EXPECT_LT((c.result.pose.target.translation() - made.truth.target.translation()).norm(),
            4.0 * c.result.sigmas->target_m);
  EXPECT_NEAR(c.corner_sigma_px, 0.05, 0.01);
  EXPECT_NEAR(c.result.noise.translation_m, 0.0002, 0.00006);
  EXPECT_LT(c.rms_px, 0.06);
  EXPECT_GT(c.arm_rms_px, 3.0 * c.rms_px);
}

TEST(PlateViews, AreBetterThanTheirPosesAlone) {
  double corners = 0.0;
  double poses = 0.0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    const MadeViews made = madeViews(20 + seed, false, 0.0001, 0.0001);
    const PlateCalibration c = calibrate(made.views);
    corners += std::pow(cameraError(c, made), 2);
    std::vector<PosePair> pairs = c.pairs;
    for (PosePair& pair : pairs) {
      pair.covariance.reset();
    }
    const auto alone =
        calibrateRobotCamera(pairs, EyeSetup::kEyeToHand, [](double, const std::string&) {});
    poses += (alone.pose.camera.translation() - made.truth.camera.translation()).squaredNorm();
  }
  EXPECT_LT(2.0 * std::sqrt(corners), std::sqrt(poses));
}

TEST(PlateViews, NameTheViewWhosePoseIsNotTheArms) {
  MadeViews made = madeViews(5, true, 0.0002, 0.0005);
  made.views[7].fMe.translation().x() += 0.02;
  const PlateCalibration c = calibrate(made.views);
  ASSERT_EQ(c.result.rejected.size(), 1U);
  EXPECT_EQ(c.result.rejected[0].name, "pair 7");
}

TEST(PlateViews, NameTheViewThatTellsNoPose) {
  MadeViews made = madeViews(5, true, 0.0002, 0.0005);
  for (CameraFeatures& camera : made.views[2].seen.cameras) {
    camera.corners.resize(1);
  }
  const PlateCalibration c = calibrate(made.views);
  ASSERT_EQ(c.blind.size(), 1U);
  EXPECT_EQ(c.blind[0].name, "pair 2");
  EXPECT_EQ(c.blind[0].index, 2U);
}

}  // namespace
}  // namespace ringhook
