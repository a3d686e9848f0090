// Pictures for a camera that asks on its own thread, of a world that another thread moves. The
// truth is the same world once more, in virtual time.

#include "sim/live_exposures.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <thread>

#include "sim/cell_world.h"
#include "sim/nominal_rig.h"

namespace ringhook {
namespace {

constexpr std::int64_t kEpoch_ns = 1'000'000'000'000;
constexpr Window kLeft{900, 700, 120, 90};
constexpr Window kRight{880, 710, 100, 80};

struct SmallCell {
  CellWorld world{CellOptions{}};
  StereoEyes eyes{world, nominalRig(), SensorOptions{}};
};

ExposureRequest request() {
  ExposureRequest asked;
  asked.regions = {kLeft, kRight};
  asked.exposure_s = 0.0005;
  return asked;
}

TEST(LiveExposures, ShowTheWorldAtTheInstantThatTheyAreStampedWith) {
  SmallCell live;
  LiveExposures exposures(live.eyes, 0.0);
  std::optional<ExposedPair> pair;
  std::atomic<bool> done = false;
  std::thread camera([&] {
    pair = exposures.expose(request());
    done = true;
  });
  while (!done) {
    live.world.advanceTo(live.world.time() + 0.004);
    exposures.worldIsAt(kEpoch_ns + live.world.time().nanoseconds());
  }
  camera.join();
  ASSERT_TRUE(pair);
  const std::int64_t instant_ns = pair->start_ns + 250'000 - kEpoch_ns;
  EXPECT_EQ(instant_ns % 4'000'000, 0);
  SmallCell again;
  again.world.advanceTo(Time::fromNanoseconds(instant_ns));
  const CapturedExposure exposure = again.eyes.capture();
  const auto images = again.eyes.develop(exposure, {kLeft, kRight}, 0);
  EXPECT_EQ(pair->images[0].pixels, images[0].pixels);
  EXPECT_EQ(pair->images[1].pixels, images[1].pixels);
}

TEST(LiveExposures, AreDarkWhileTheWorldStandsStill) {
  SmallCell cell;
  LiveExposures exposures(cell.eyes, 0.0);
  const auto pair = exposures.expose(request());
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->images[0].pixels, std::vector<std::uint8_t>(120 * 90, 0));
}

TEST(LiveExposures, OfOneCameraLeaveTheOtherOut) {
  SmallCell cell;
  const CapturedExposure exposure = cell.eyes.capture();
  const auto images = cell.eyes.develop(exposure, {Window{}, kRight}, 0);
  EXPECT_TRUE(images[0].empty());
  EXPECT_EQ(images[1].width, kRight.width);
}

TEST(LiveExposures, EndWhenClosed) {
  SmallCell cell;
  LiveExposures exposures(cell.eyes, 0.0);
  exposures.close();
  EXPECT_FALSE(exposures.expose(request()));
}

}  // namespace
}  // namespace ringhook
