#include "camera/readout_region.h"

#include <gtest/gtest.h>

#include <random>

namespace ringhook {
namespace {

RegionLimits sensor(int size_step, int offset_step) {
  return {2048, 1536, {64, size_step, offset_step}, {32, size_step, offset_step}};
}

bool holds(const Window& region, const Window& asked) { return intersect(asked, region) == asked; }

TEST(ReadoutRegion, HoldsTheAskedWindowInItsMiddle) {
  const Window region = readoutRegion({800, 600, 300, 200}, {}, sensor(1, 1));
  EXPECT_EQ(region, (Window{800 - 42, 600 - 28, 384, 256}));
}

TEST(ReadoutRegion, AnEmptyWindowMeansTheWholeSensor) {
  EXPECT_EQ(readoutRegion({}, {}, sensor(1, 1)), (Window{0, 0, 2048, 1536}));
  EXPECT_EQ(readoutRegion({5000, 5000, 10, 10}, {}, sensor(1, 1)), (Window{0, 0, 2048, 1536}));
}

TEST(ReadoutRegion, StaysOnTheSensorAtItsBorders) {
  const Window corner = readoutRegion({2000, 1500, 100, 100}, {}, sensor(1, 1));
  EXPECT_EQ(corner, (Window{2048 - 128, 1536 - 128, 128, 128}));
  EXPECT_EQ(readoutRegion({-20, -20, 100, 100}, {}, sensor(1, 1)), (Window{0, 0, 128, 128}));
}

TEST(ReadoutRegion, KeepsItsSizeWhileTheWindowBreathes) {
  const RegionLimits limits = sensor(1, 1);
  Window region = readoutRegion({500, 500, 250, 250}, {}, limits);
  EXPECT_EQ(region.width, 256);
  region = readoutRegion({500, 500, 260, 250}, region, limits);
  EXPECT_EQ(region.width, 384);
  for (const int side : {250, 300, 200, 384, 180}) {
    region = readoutRegion({500, 500, side, side}, region, limits);
    EXPECT_EQ(region.width, 384) << side;
  }
  region = readoutRegion({500, 500, 100, 100}, region, limits);
  EXPECT_EQ(region.width, 384);  // two rungs too large: bearable
  region = readoutRegion({}, region, limits);
  region = readoutRegion({500, 500, 100, 100}, region, limits);
  EXPECT_EQ(region.width, 128);  // a whole sensor for that: not
}

TEST(ReadoutRegion, EveryAnswerKeepsTheCamerasRules) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> place(-300, 2300);
  std::uniform_int_distribution<int> size(1, 1500);
  std::uniform_int_distribution<int> step(0, 4);
  Window region;
  for (int i = 0; i < 20000; ++i) {
    const RegionLimits limits = sensor(1 << step(random), 1 << step(random));
    const Window full{0, 0, 2048, 1536};
    const Window asked{place(random), place(random), size(random), size(random)};
    region = readoutRegion(asked, region, limits);
    ASSERT_EQ(intersect(region, full), region);
    ASSERT_TRUE(holds(region, intersect(asked, full)) || intersect(asked, full).empty());
    ASSERT_EQ(region.x % limits.x.offset, 0);
    ASSERT_EQ(region.y % limits.y.offset, 0);
    ASSERT_GE(region.width, limits.x.smallest);
    if (i % 20 == 0) {
      region = {};  // sizes of another camera need not fit this one's steps
    }
  }
}

TEST(ReadoutRegion, SizesAreMultiplesOfTheStep) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> size(1, 2048);
  const RegionLimits limits = {2050, 1537, {64, 16, 4}, {32, 8, 2}};
  Window region;
  for (int i = 0; i < 5000; ++i) {
    region =
        readoutRegion({size(random), size(random), size(random), size(random)}, region, limits);
    ASSERT_EQ(region.width % 16, 0);
    ASSERT_EQ(region.height % 8, 0);
  }
}

}  // namespace
}  // namespace ringhook
