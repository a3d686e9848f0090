// Robot-camera calibration in the simulated cell: rendered pictures, an arm with zero errors in its
// joints, cameras that stand a little off. More seeds and poses: bench robot_camera_rendered.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rendered_cell.h"

namespace ringhook {
namespace {

TEST(RenderedRobotCamera, CubeLeavesLessThanTheReportsTwoMillimetres) {
  RenderedCell cell(3);
  const PointFit fit = fitPoints(RenderedCell::pointsOf(cell.cube(0.2)));
  EXPECT_LE(1e3 * fit.residual_m, 0.4);
  EXPECT_TRUE(fit.rejected.empty());
  EXPECT_NE(fit.verdict.grade, Grade::kPoor) << fit.verdict.sentence;
}

TEST(RenderedRobotCamera, PosesPredictOthersByTheArmWithItsJointZerosCorrected) {
  RenderedCell cell(1);  // of the first seeds the one with the worst arm
  const auto views = cell.around(16, 1);
  ASSERT_EQ(views.size(), 16U);
  const auto calibrate = [&views](ZeroChoice choice) {
    return calibrateFromViews(views, EyeSetup::kEyeToHand, choice,
                              [](double, const std::string&) {});
  };
  const PlateCalibration plain = calibrate(ZeroChoice::kKeep);
  const PlateCalibration c = calibrate(ZeroChoice::kWherePaying);
  EXPECT_NE(c.result.verdict.grade, Grade::kPoor) << c.result.verdict.sentence;
  EXPECT_FALSE(plain.zeros_used);
  EXPECT_TRUE(c.zeros_used);
  EXPECT_LE(1e3 * c.result.heldout.translation_m, 0.15);
  EXPECT_GT(1e3 * c.plain_heldout.translation_m, 0.2);
  const double ring_m = cell.ringError(c.result.pose.camera, c.arm_zeros_rad);
  EXPECT_LE(1e3 * ring_m, 0.1);
  EXPECT_LT(ring_m, 0.3 * cell.ringError(plain.result.pose.camera, JointVector::Zero()));
  ASSERT_TRUE(c.result.sigmas);
  EXPECT_LT(ring_m, 5.0 * c.result.sigmas->workspace_m);  // "at most", as the verdict says
  const Eigen::Vector3d plate = c.result.pose.target.translation();
  EXPECT_LT(1e3 * (plate - RenderedCell::trueTarget().translation()).norm(), 0.5);
}

}  // namespace
}  // namespace ringhook
