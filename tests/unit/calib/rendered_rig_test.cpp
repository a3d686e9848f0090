// Ten rendered pairs of the simulated cell against its truth; tests/bench/stereo_rendered does 25.

#include <gtest/gtest.h>

#include <cmath>

#include "calib/solve/stereo_calibration.h"
#include "cell_views.h"

namespace ringhook {
namespace {

TEST(RenderedRig, IsFoundFromTenPairsOfPictures) {
  StereoViews views;
  renderViews(workspaceBoard(), 10, 1, 1, [&](int i, const StereoFrame& frame) {
    const auto left = findBoard(frame.left, workspaceBoard());
    const auto right = findBoard(frame.right, workspaceBoard());
    if (left && right) {
      const std::string number = std::to_string(i);
      views.usable.push_back({"left" + number, "right" + number, frame.left.width,
                              frame.left.height, *left,
                              orderedLike(*left, *right, workspaceBoard())});
    }
  });
  ASSERT_GE(views.usable.size(), 8U);
  const auto c = calibrateStereo(views, workspaceBoard(), {LensTerms::kFive},
                                 [](double, const std::string&) {});
  const StereoRig truth = trueCellRig(1);
  EXPECT_NEAR(c.rig.left.K(0, 0), truth.left.K(0, 0), 5e-4 * truth.left.K(0, 0));
  EXPECT_NEAR(baseline(c.rig), baseline(truth), 5e-4 * baseline(truth));
  EXPECT_LT(c.heldout_vertical_disparity_px, 0.04);
  EXPECT_LT(barError(c.rig, truth, 0.0, 1), 3e-5);
}

}  // namespace
}  // namespace ringhook
