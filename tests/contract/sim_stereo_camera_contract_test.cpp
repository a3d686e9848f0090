#include "core/error.h"
#include "sim/cell_world.h"
#include "sim/nominal_rig.h"
#include "sim/sim_stereo_camera.h"
#include "stereo_camera_contract.h"

namespace ringhook {
namespace {

/// The nominal rig on a sensor of a quarter of its size: full images are drawn quickly.
StereoRig smallRig() {
  StereoRig rig = nominalRig();
  for (CameraModel* camera : {&rig.left, &*rig.right}) {
    camera->width /= 4;
    camera->height /= 4;
    camera->K.topRows<2>() *= 0.25;
  }
  return rig;
}

class SimCameraUnderTest : public StereoCameraUnderTest {
 public:
  SimCameraUnderTest() : world_(CellOptions{}), camera_(world_, smallRig()) {}
  StereoCamera& camera() override { return camera_; }
  void pass(double seconds) override { world_.advanceTo(world_.time() + seconds); }
  [[nodiscard]] bool chooses() const override { return true; }
  [[nodiscard]] double rateHz() const override { return 50.0; }
  CellWorld& world() { return world_; }

 private:
  CellWorld world_;
  SimStereoCamera camera_;
};

std::unique_ptr<StereoCameraUnderTest> makeSimCamera() {
  return std::make_unique<SimCameraUnderTest>();
}

INSTANTIATE_TEST_SUITE_P(Simulated, StereoCameraContract, ::testing::Values(&makeSimCamera));

TEST(SimStereoCamera, FrameArrivesAfterTheTransportDelay) {
  SimCameraUnderTest held;
  held.world().advanceTo(Time::fromSeconds(0.0075));
  EXPECT_FALSE(held.camera().grab(0.0).has_value());
  held.world().advanceTo(Time::fromSeconds(0.0080));
  const auto frame = held.camera().grab(0.0);
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->time, Time());
  EXPECT_FALSE(held.camera().grab(0.0).has_value());
}

TEST(SimStereoCamera, SameSeedGivesTheSamePixels) {
  SimCameraUnderTest one;
  SimCameraUnderTest two;
  for (SimCameraUnderTest* held : {&one, &two}) {
    held->world().advanceTo(Time::fromSeconds(0.03));
  }
  (void)one.camera().grab(0.0);
  (void)two.camera().grab(0.0);
  const auto a = one.camera().grab(0.0);
  const auto b = two.camera().grab(0.0);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->index, 1U);
  EXPECT_EQ(a->left.pixels, b->left.pixels);
  EXPECT_EQ(a->right.pixels, b->right.pixels);
}

TEST(SimStereoCamera, QueueKeepsTheNewestFrames) {
  SimCameraUnderTest held;
  held.camera().setWindows({0, 0, 16, 16}, {0, 0, 16, 16});
  held.world().advanceTo(Time::fromSeconds(0.99));  // 50 exposures
  std::vector<std::uint64_t> indices;
  while (const auto frame = held.camera().grab(0.0)) {
    indices.push_back(frame->index);
  }
  ASSERT_EQ(indices.size(), 32U);
  EXPECT_EQ(indices.front(), 18U);
  EXPECT_EQ(indices.back(), 49U);
}

TEST(SimStereoCamera, RefusesARigWithoutPlaceInTheCell) {
  CellWorld world(CellOptions{});
  StereoRig rig = smallRig();
  rig.fMc1.reset();
  EXPECT_THROW(SimStereoCamera(world, rig), Error);
}

}  // namespace
}  // namespace ringhook
