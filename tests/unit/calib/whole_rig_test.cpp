// From drawn pictures of every kind of board to the rig that they were drawn for.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "board_scene.h"
#include "calib/solve/stereo_calibration.h"

namespace ringhook {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

StereoRig drawnRig() {
  StereoRig rig;
  rig.left.width = kWidth;
  rig.left.height = kHeight;
  rig.left.K << 600, 0, 322, 0, 601, 238, 0, 0, 1;
  rig.left.distortion = Eigen::VectorXd::Zero(5);
  rig.right = rig.left;
  rig.right->K << 606, 0, 317, 0, 605, 243, 0, 0, 1;
  rig.c2Mc1 = makePoseThetaU({-0.08, 0.001, 0.003}, {0.008, -0.12, 0.005});
  return rig;
}

// The board's middle before both cameras, tilted in another direction each time.
Pose heldAt(const Board& board, int view) {
  const double direction = 2.4 * view;
  const Pose turned =
      makePoseThetaU({0, 0, 0}, {0.5 * std::cos(direction), 0.5 * std::sin(direction), 0.1});
  const Eigen::Vector3d middle(0.04 + 0.03 * std::cos(1.7 * view), 0.03 * std::sin(1.7 * view),
                               0.48 + 0.02 * (view % 4));
  Pose c1Mt = turned;
  c1Mt.translation() = middle - turned * middleOf(board);
  return c1Mt;
}

GrayImage noisy(GrayImage image, std::mt19937& random) {
  std::normal_distribution<double> grain(0.0, 2.0);
  for (int v = 0; v < image.height; ++v) {
    std::uint8_t* row = image.row(v);
    std::transform(row, row + image.width, row, [&](std::uint8_t grey) {
      return static_cast<std::uint8_t>(std::clamp(std::lround(grey + grain(random)), 0L, 255L));
    });
  }
  return image;
}

class WholeRig : public ::testing::TestWithParam<const char*> {};

TEST_P(WholeRig, IsFoundFromPicturesOf) {
  const Board board = parseBoard(GetParam());
  const StereoRig truth = drawnRig();
  std::mt19937 random(7);
  StereoViews views;
  for (int i = 0; i < 8; ++i) {
    const Pose c1Mt = heldAt(board, i);
    const auto see = [&](const CameraModel& camera, const Pose& cMt) {
      return findBoard(noisy(drawBoard(board, camera.K, cMt, kWidth, kHeight), random), board);
    };
    const auto left = see(truth.left, c1Mt);
    const auto right = see(*truth.right, truth.c2Mc1 * c1Mt);
    ASSERT_TRUE(left) << i << ": " << left.reason();
    ASSERT_TRUE(right) << i << ": " << right.reason();
    const std::string number = std::to_string(i);
    views.usable.push_back({"left" + number, "right" + number, kWidth, kHeight, *left,
                            orderedLike(*left, *right, board)});
  }
  const StereoCalibration c =
      calibrateStereo(views, board, {LensTerms::kNone}, [](double, const std::string&) {});
  ASSERT_TRUE(c.uncertainty);
  const double focal_error = (c.rig.left.K(0, 0) - truth.left.K(0, 0)) / c.uncertainty->focal_px;
  const double baseline_error = (baseline(c.rig) - baseline(truth)) / c.uncertainty->baseline_m;
  std::cout << "focal length off by " << focal_error << " of " << c.uncertainty->focal_px
            << " px, baseline by " << baseline_error << " of " << 1e3 * c.uncertainty->baseline_m
            << " mm, held-out " << c.heldout_vertical_disparity_px << " px, corners "
            << c.corner_sigma_px << " px\n";
  EXPECT_EQ(c.used.size(), 8U);
  // In standard deviations; the bias of circles' centres left in would be 3.6 and 3.7 of them.
  EXPECT_LT(std::abs(focal_error), 3.0);
  EXPECT_LT(std::abs(baseline_error), 3.0);
  EXPECT_LT(thetaU(c.rig.c2Mc1.linear() * truth.c2Mc1.linear().transpose()).norm(), 2e-3);
  EXPECT_LT(c.heldout_vertical_disparity_px, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Boards, WholeRig,
                         ::testing::Values("chessboard:9x6:25mm", "charuco:8x6:30mm:22mm",
                                           "circles:8x6:28mm:14mm", "acircles:4x11:18mm:10mm",
                                           "apriltags:4x3:50mm:36mm"));

}  // namespace
}  // namespace ringhook
