#include "calib/wizard/arm_poses.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>

namespace ringhook {
namespace {

Pose anywhere() { return makePoseThetaU({0.4, -0.1, 0.7}, {0.3, -1.2, 0.5}); }

TEST(ArmPoses, StandAtTheCornersOfTheCube) {
  for (const Pose& fMe : armPoses(anywhere(), {0.2, 0.35})) {
    const Eigen::Vector3d away = fMe.translation() - anywhere().translation();
    EXPECT_NEAR(away.cwiseAbs().minCoeff(), 0.1, 1e-12);
    EXPECT_NEAR(away.cwiseAbs().maxCoeff(), 0.1, 1e-12);
  }
}

TEST(ArmPoses, TurnAboutAllAxesOfTheFlangeAlike) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> turns(3, 24);
  int column = 0;
  for (const Pose& fMe : armPoses(anywhere())) {
    turns.col(column++) = logSe3(anywhere().inverse() * fMe).tail<3>();
  }
  const Eigen::Vector3d spread = turns.jacobiSvd().singularValues();
  EXPECT_GT(spread(2), 0.5 * spread(0));
  EXPECT_LT(turns.rowwise().mean().norm(), 0.1);  // no direction is preferred
}

TEST(ArmPoses, NeighboursAreNear) {
  const auto poses = armPoses(anywhere());
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_LE((poses[i].translation() - poses[i - 1].translation()).norm(), 0.2 + 1e-12);
  }
}

}  // namespace
}  // namespace ringhook
