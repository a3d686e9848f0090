#include "sim/shared_trigger.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace ringhook {
namespace {

constexpr double kForEver_s = 1000.0;

/// Pictures whose grey is their region's column; the stamp counts pairs.
class CountingSource {
 public:
  std::optional<ExposedPair> operator()(const ExposureRequest& request) {
    ExposedPair pair;
    pair.start_ns = ++pairs;
    for (std::size_t side = 0; side < 2; ++side) {
      const Window& w = request.regions[side];
      if (!w.empty()) {
        pair.images[side] = GrayImage(w.width, w.height, static_cast<std::uint8_t>(w.x));
      }
    }
    return pair;
  }
  std::int64_t pairs = 0;
};

TEST(SharedTrigger, BothCamerasExposeAtTheSameInstantEachItsOwnRegion) {
  CountingSource source;
  SharedTrigger trigger(std::ref(source), kForEver_s);
  constexpr int kPairs = 500;
  std::vector<std::int64_t> stamps[2];
  const auto camera = [&](int side) {
    for (int i = 0; i < kPairs; ++i) {
      const int column = i % 100 + 100 * side;
      const auto exposed = trigger.expose(side, {column, 0, 3, 2}, 0.001);
      ASSERT_TRUE(exposed);
      EXPECT_EQ(exposed->image.pixels, std::vector<std::uint8_t>(6, column));
      stamps[side].push_back(exposed->start_ns);
    }
  };
  std::thread left(camera, 0);
  std::thread right(camera, 1);
  left.join();
  right.join();
  EXPECT_EQ(stamps[0], stamps[1]);
  EXPECT_EQ(source.pairs, kPairs);
}

TEST(SharedTrigger, ACameraWhosePartnerDoesNotComeExposesAlone) {
  CountingSource source;
  SharedTrigger trigger(std::ref(source), 0.0);
  const auto exposed = trigger.expose(1, {7, 0, 2, 2}, 0.001);
  ASSERT_TRUE(exposed);
  EXPECT_EQ(exposed->image.pixels.front(), 7);
  EXPECT_EQ(source.pairs, 1);
}

TEST(SharedTrigger, ClosingLetsAWaitingCameraGo) {
  CountingSource source;
  SharedTrigger trigger(std::ref(source), kForEver_s);
  std::thread left([&] { EXPECT_FALSE(trigger.expose(0, {0, 0, 2, 2}, 0.001)); });
  trigger.close();
  left.join();
  EXPECT_FALSE(trigger.expose(1, {0, 0, 2, 2}, 0.001));
  EXPECT_EQ(source.pairs, 0);
}

TEST(SharedTrigger, AFailingSourceLetsBothGo) {
  SharedTrigger trigger(
      [](const ExposureRequest&) -> std::optional<ExposedPair> {
        throw std::runtime_error("dark");
      },
      kForEver_s);
  std::atomic<int> thrown = 0;
  std::atomic<int> nothing = 0;
  const auto camera = [&](int side) {
    try {
      nothing += trigger.expose(side, {0, 0, 2, 2}, 0.001) ? 0 : 1;
    } catch (const std::runtime_error&) {
      ++thrown;
    }
  };
  std::thread left(camera, 0);
  std::thread right(camera, 1);
  left.join();
  right.join();
  EXPECT_EQ(thrown, 1);
  EXPECT_EQ(nothing, 1);
}

}  // namespace
}  // namespace ringhook
