#include "robot/rx60/tool_point.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "joint_samples.h"

namespace ringhook::rx60 {
namespace {

TEST(ToolPoint, AgreesWithLinkFramesAndTheDeterminant) {
  JointSamples samples(81);
  const Eigen::Vector3d tool_e(0.03, -0.07, 0.15);
  for (const Geometry& geometry : {rx60(), rx60L()}) {
    for (int k = 0; k < 2000; ++k) {
      const JointVector q = samples.within(limits());
      const ToolPoint tool = toolPoint(geometry, tool_e, q);
      const Pose fMe = forward(geometry, q);
      const Jacobian fJe = jacobian(geometry, q);
      EXPECT_LT((tool.position - fMe * tool_e).norm(), 1e-13);
      for (int i = 0; i < 6; ++i) {
        const Eigen::Vector3d linear = fJe.block<3, 1>(0, i);
        const Eigen::Vector3d angular = fJe.block<3, 1>(3, i);
        EXPECT_LT((tool.fJ.col(i) - linear - angular.cross(fMe.linear() * tool_e)).norm(), 1e-13);
      }
      EXPECT_NEAR(tool.manipulability, std::abs(fJe.determinant()), 1e-14);
    }
  }
}

}  // namespace
}  // namespace ringhook::rx60
