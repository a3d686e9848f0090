// Robot-camera calibration in the simulated cell: rendered pictures, an arm with zero errors in its
// joints, cameras that stand a little off. More seeds and poses: bench robot_camera_rendered.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/solve/joint_zeros.h"
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

TEST(RenderedRobotCamera, PosesPredictOthersOnceTheJointZerosAreKnown) {
  RenderedCell cell(1);  // of the first seeds the one with the worst arm
  const auto views = cell.around(16, 1);
  ASSERT_EQ(views.size(), 16U);
  const PlateCalibration c =
      calibrateFromViews(views, EyeSetup::kEyeToHand, [](double, const std::string&) {});
  EXPECT_NE(c.result.verdict.grade, Grade::kPoor) << c.result.verdict.sentence;
  const JointZeros zeros = fitJointZeros(c.pairs, cell.joints(), rx60::rx60(), c.result);
  EXPECT_LT(zeros.heldout.translation_m, c.result.heldout.translation_m);
  EXPECT_LE(1e3 * zeros.heldout.translation_m, 0.15);
  const Eigen::Vector3d plate = c.result.pose.target.translation();
  EXPECT_LT(1e3 * (plate - RenderedCell::trueTarget().translation()).norm(), 0.5);
}

}  // namespace
}  // namespace ringhook
