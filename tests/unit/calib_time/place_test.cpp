// Places for calibration: the simulated integrator's board is seen where it is held, the arm goes
// where it is sent or says why not, and nothing that goes wrong leaves it moving.

#include "calib/wizard/place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <set>

#include "../../support/scratch_folder.h"
#include "camera/image_file.h"
#include "core/error.h"
#include "robot/arm.h"
#include "robot/rx60/kinematics.h"
#include "sim/nominal_rig.h"

namespace ringhook {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::HasSubstr;

CellConfig simulatedCell() {
  return loadCellConfig(RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml");
}

std::unique_ptr<CalibrationPlace> place(std::uint64_t seed = 1) {
  SimulatedPlaceOptions options;
  options.seed = seed;
  return openSimulatedPlace(simulatedCell(), options);
}

/// Faces the cameras, its middle at `middle_f` [m].
Pose facing(const HeldBoard& board, const Vector3d& middle_f) {
  Pose fMt = Pose::Identity();
  fMt.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  fMt.linear() = Eigen::AngleAxisd(0.2, Vector3d(0.3, 0.5, 1.0).normalized()) * fMt.linear();
  fMt.translation() = middle_f - fMt.linear() * (0.5 * board.square_m *
                                                 Vector3d(board.columns - 1, board.rows - 1, 0.0));
  return fMt;
}

/// Longest way from a corner that OpenCV finds to where the nominal rig expects it [px]; huge if
/// the board is not found.
double farthest(GrayImage image, const CameraModel& camera, const Pose& cMt,
                const HeldBoard& board) {
  const cv::Mat wrapped(image.height, image.width, CV_8UC1, image.pixels.data());
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(wrapped, {board.columns, board.rows}, corners,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_FAST_CHECK)) {
    return 1e9;
  }
  double worst = 0.0;
  for (int j = 0; j < board.rows; ++j) {
    for (int i = 0; i < board.columns; ++i) {
      const Vector3d p = cMt * Vector3d(i * board.square_m, j * board.square_m, 0.0);
      const Vector2d expected = projectNormalised(camera, p.head<2>() / p.z());
      double nearest = 1e9;  // the detector may number them from the other end
      for (const cv::Point2f& corner : corners) {
        nearest = std::min(nearest, (expected - Vector2d(corner.x, corner.y)).norm());
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

TEST(SimulatedPlace, ShowsTheBoardWhereItIsHeldAndNoneOnceItIsTakenAway) {
  const HeldBoard board;
  const auto cell = place();
  ASSERT_TRUE(cell->canHoldBoard());
  const Pose fMt = facing(board, {0.60, 0.02, 0.72});
  cell->holdBoard(fMt);
  const auto pair = cell->takePair();
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->left_window, cell->fullImage());
  const StereoRig rig = nominalRig();
  const Pose c1Mt = rig.fMc1->inverse() * fMt;
  EXPECT_LT(farthest(pair->left, rig.left, c1Mt, board), 3.0);
  EXPECT_LT(farthest(pair->right, *rig.right, rig.c2Mc1 * c1Mt, board), 3.0);
  cell->holdBoard(std::nullopt);
  EXPECT_GT(farthest(cell->takePair()->left, rig.left, c1Mt, board), 1e6);
}

TEST(SimulatedPlace, MovesTheFlangeWhereItIsAskedAndComesToRest) {
  const auto cell = place();
  const Pose fMe = *cell->flange();
  const Pose target = fMe * makePoseThetaU({0.02, -0.03, 0.05}, {0.05, 0.1, -0.08});
  const Outcome<Pose> reached = cell->moveFlange(target);
  ASSERT_TRUE(reached) << reached.reason();
  EXPECT_LT((reached->translation() - target.translation()).norm(), 2e-4);
  EXPECT_LT(thetaU(reached->linear().transpose() * target.linear()).norm(), 1e-3);
  EXPECT_LT((cell->flange()->translation() - reached->translation()).norm(), 1e-5);
}

TEST(SimulatedPlace, RefusesAMoveWithItsReasonAndStandsStill) {
  const auto cell = place();
  const JointVector before = cell->armState()->position;
  const auto refusal = [&](const Vector3d& position_f) {
    Pose fMe = *cell->flange();
    fMe.translation() = position_f;
    const Outcome<Pose> moved = cell->moveFlange(fMe);
    return moved ? std::string("moved") : moved.reason();
  };
  EXPECT_THAT(refusal({2.0, 0.0, 0.5}), HasSubstr("reach"));
  EXPECT_THAT(refusal({0.28, -0.10, 0.85}), HasSubstr("belt"));
  EXPECT_THAT(refusal({0.45, -0.10, 0.05}), HasSubstr("floor"));
  JointVector beyond = before;
  beyond[4] = 3.0;
  EXPECT_FALSE(cell->moveJoints(beyond));
  EXPECT_LT((cell->armState()->position - before).norm(), 1e-9);
}

TEST(SimulatedPlace, AnInterruptionStopsTheArmBeforeItGoesOn) {
  const auto cell = place();
  int steps = 0;
  cell->onStep([&] {
    if (++steps == 200) {
      throw Interrupted("stopped by the operator");
    }
  });
  const Pose target = *cell->flange() * makePoseThetaU({0.10, 0.0, 0.0}, Vector3d::Zero());
  EXPECT_THROW((void)cell->moveFlange(target), Interrupted);
  const ArmState after = cell->devices()->arm.waitState();
  EXPECT_FALSE(after.motion_possible);
  const ArmState later = cell->devices()->arm.waitState();
  for (int i = 0; i < 5; ++i) {
    (void)cell->devices()->arm.waitState();
  }
  EXPECT_LT((cell->devices()->arm.waitState().position - later.position).norm(), 0.01);
  EXPECT_LT(cell->devices()->arm.waitState().velocity.norm(), 1e-9);
  EXPECT_THROW((void)cell->moveFlange(target), DeviceError) << "nothing moves until rearm()";
}

TEST(SimulatedPlace, IsTheSameForOneSeedAndAnotherForAnother) {
  const auto shot = [](std::uint64_t seed) { return place(seed)->takePair()->left.pixels; };
  const auto one = shot(3);
  EXPECT_TRUE(one == shot(3));
  EXPECT_FALSE(one == shot(4));
}

TEST(SimulatedPlace, RefusesACellThatIsNotSimulated) {
  CellConfig cell = simulatedCell();
  cell.devices.kind = DeviceKind::kNetwork;
  EXPECT_THROW(openSimulatedPlace(cell, {}), InputError);
  EXPECT_THROW(openNetworkPlace(simulatedCell()), InputError);
}

class StoredFolder : public ::testing::Test {
 protected:
  void addPairs(int left, int right) const {
    for (int i = 0; i < left; ++i) {
      writeGrayImage(scratch_.path() / "left" / (std::to_string(i) + ".pgm"),
                     GrayImage(8, 6, static_cast<std::uint8_t>(10 + i)));
    }
    for (int i = 0; i < right; ++i) {
      writeGrayImage(scratch_.path() / "right" / (std::to_string(i) + ".pgm"),
                     GrayImage(8, 6, static_cast<std::uint8_t>(50 + i)));
    }
  }
  void addArm(const std::string& rows) const {
    (void)scratch_.write(
        "robot.csv", "time_s,j1_rad,j2_rad,j3_rad,j4_rad,j5_rad,j6_rad,x,y,z,qx,qy,qz,qw\n" + rows);
  }
  ScratchFolder scratch_;
};

TEST_F(StoredFolder, GivesItsPairsInOrderWithTheArmBesideThem) {
  addPairs(2, 2);
  addArm("0,1,2,3,4,5,6,0.1,0.2,0.3,0,0,0,1\n1,2,2,3,4,5,6,0.4,0.2,0.3,0,0,0,1\n");
  const auto stored = openStoredPlace(scratch_.path());
  EXPECT_EQ(stored->fullImage(), (Window{0, 0, 8, 6}));
  EXPECT_FALSE(stored->flange()) << "no pair was taken yet";
  EXPECT_EQ(stored->takePair()->left.pixels[0], 10);
  EXPECT_EQ(stored->takePair()->right.pixels[0], 51);
  EXPECT_NEAR(stored->flange()->translation().x(), 0.4, 1e-15);
  EXPECT_EQ(stored->armState()->position[0], 2.0);
  EXPECT_FALSE(stored->takePair());
  EXPECT_FALSE(stored->canMoveArm());
  EXPECT_EQ(stored->devices(), nullptr);
  EXPECT_THROW(stored->holdBoard(std::nullopt), Error);
}

TEST_F(StoredFolder, RefusesWhatDoesNotFitTogether) {
  const auto refusal = [this] {
    return messageOf<InputError>([this] { (void)openStoredPlace(scratch_.path()); });
  };
  EXPECT_THAT(refusal(), HasSubstr("left/ and right/"));
  addPairs(2, 1);
  EXPECT_THAT(refusal(), HasSubstr("found 2 and 1"));
  addPairs(2, 2);
  addArm("0,1,2,3,4,5,6,0.1,0.2,0.3,0,0,0,1\n");
  EXPECT_THAT(refusal(), HasSubstr("a row for each of the 2 pairs"));
  addArm("0,1,2,3,4,5,6,0.1,0.2,0.3,0,0,0,1\n1,2,2,3,4,5,6,0.4,0.2,0.3,0,0,0,3\n");
  EXPECT_THAT(refusal(), HasSubstr("quaternion"));
  EXPECT_THROW(openStoredPlace(scratch_.path() / "nowhere"), InputError);
}

TEST(StoredPlace, TellsTheArmBetweenTheRowsOfASequence) {
  const auto stored = openStoredPlace(RINGHOOK_SOURCE_DIR "/datasets/clips/swing-marker");
  EXPECT_FALSE(stored->armState());
  ASSERT_TRUE(stored->takePair());
  const Outcome<ArmState> arm = stored->armState();
  ASSERT_TRUE(arm) << arm.reason();
  const Pose fMe = rx60::forward(rx60::rx60(), arm->position);
  EXPECT_LT((fMe.translation() - stored->flange()->translation()).norm(), 1e-6);
}

}  // namespace
}  // namespace ringhook
