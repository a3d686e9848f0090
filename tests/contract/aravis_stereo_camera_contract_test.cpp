// The product's camera driver against Aravis's fake cameras on loopback, in a network of its own.
// What is sent is known: each pixel tells its column, its row and its side.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include "../support/own_network.h"
#include "camera/aravis_stereo_camera.h"
#include "core/error.h"
#include "sim/gige_server.h"
#include "stereo_camera_contract.h"

namespace ringhook {
namespace {

constexpr double kRateHz = 50.0;

class OwnNetwork : public ::testing::Environment {
 public:
  void SetUp() override {
    if (!test::ownNetwork().empty()) {
      GTEST_SKIP() << test::ownNetwork();
    }
  }
};
[[maybe_unused]] const auto* const kNetwork =
    ::testing::AddGlobalTestEnvironment(std::make_unique<OwnNetwork>().release());

std::uint8_t greyAt(int side, int x, int y) {
  return static_cast<std::uint8_t>(7 * x + 13 * y + 101 * side);
}

GrayImage pattern(int side, const Window& region) {
  GrayImage image(region.width, region.height);
  for (int y = 0; y < region.height; ++y) {
    std::uint8_t* row = image.row(y);
    for (int x = 0; x < region.width; ++x) {
      row[x] = greyAt(side, region.x + x, region.y + y);
    }
  }
  return image;
}

/// Exposures on whole multiples of `period_s` of the host's real time, no two at the same one.
class PatternSource {
 public:
  explicit PatternSource(double period_s) : period_ns_(std::llround(1e9 * period_s)) {}
  std::optional<ExposedPair> operator()(const ExposureRequest& request) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto now_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
    count_ = std::max(count_ + 1, now_ns / period_ns_);
    ExposedPair pair;
    pair.start_ns = count_ * period_ns_;
    for (int side = 0; side < 2; ++side) {
      const Window& region = request.regions[static_cast<std::size_t>(side)];
      pair.images[static_cast<std::size_t>(side)] = pattern(side, region);
    }
    return pair;
  }

 private:
  std::int64_t period_ns_;
  std::int64_t count_ = 0;
};

AravisOptions optionsOf(CameraTrigger trigger) {
  AravisOptions options;
  options.left.device = "127.0.0.1";
  options.right.device = "127.0.0.2";
  options.left.trigger = options.right.trigger = trigger;
  options.left.packet_bytes = options.right.packet_bytes = 8000;
  options.clock = CameraClock::kHost;
  options.rate_hz = kRateHz;
  return options;
}

class AravisUnderTest : public StereoCameraUnderTest {
 public:
  explicit AravisUnderTest(CameraTrigger trigger, double lost_packets = 0.0)
      : server_({"127.0.0.1", "127.0.0.2", lost_packets}, PatternSource(1.0 / kRateHz)),
        camera_(optionsOf(trigger)) {}
  StereoCamera& camera() override { return camera_; }
  AravisStereoCamera& aravis() { return camera_; }
  void pass(double /*seconds*/) override {}
  [[nodiscard]] bool chooses() const override { return true; }
  [[nodiscard]] double rateHz() const override { return kRateHz; }
  [[nodiscard]] bool realTime() const override { return true; }

 private:
  GigeServer server_;
  AravisStereoCamera camera_;
};

std::unique_ptr<StereoCameraUnderTest> makeFreeRunning() {
  return std::make_unique<AravisUnderTest>(CameraTrigger::kFreeRun);
}
std::unique_ptr<StereoCameraUnderTest> makeTriggered() {
  return std::make_unique<AravisUnderTest>(CameraTrigger::kSoftware);
}

INSTANTIATE_TEST_SUITE_P(AravisFreeRunning, StereoCameraContract,
                         ::testing::Values(&makeFreeRunning));
INSTANTIATE_TEST_SUITE_P(AravisTriggered, StereoCameraContract, ::testing::Values(&makeTriggered));

std::optional<StereoFrame> next(StereoCamera& camera) {
  for (int tries = 0; tries < 600; ++tries) {
    if (auto frame = camera.grab(0.1)) {
      return frame;
    }
  }
  return std::nullopt;
}

TEST(AravisStereoCamera, EveryPixelIsOfTheRegionThatItsFrameNames) {
  AravisUnderTest held(CameraTrigger::kFreeRun);
  for (int i = 0; i < 25; ++i) {
    held.camera().setWindows({100 + 11 * i, 200 + 7 * i, 200, 180}, {900 - 9 * i, 300, 200, 180});
    const auto frame = next(held.camera());
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->left.pixels, pattern(0, frame->left_window).pixels) << i;
    ASSERT_EQ(frame->right.pixels, pattern(1, frame->right_window).pixels) << i;
  }
  // How many stay alone depends on the machine: the served cameras leave out what they are late
  // for.
}

TEST(AravisStereoCamera, StampsAreTheExposuresOnTheHostsSteadyClock) {
  AravisUnderTest held(CameraTrigger::kFreeRun);
  const auto frame = next(held.camera());
  ASSERT_TRUE(frame);
  const auto real = std::chrono::system_clock::now().time_since_epoch();
  const auto steady = std::chrono::steady_clock::now().time_since_epoch();
  const double offset_s =
      std::chrono::duration<double>(real).count() - std::chrono::duration<double>(steady).count();
  // Exposures start on multiples of the period in real time; a stamp is mid-exposure, 0.25 ms on.
  const double periods = (frame->time.seconds() + offset_s - 0.00025) * kRateHz;
  EXPECT_NEAR(periods, std::round(periods), 1e-3);
}

TEST(AravisStereoCamera, LostPacketsAreToldAndTheirImagesAreNotDelivered) {
  AravisUnderTest held(CameraTrigger::kFreeRun, 0.01);
  held.camera().setWindows({0, 0, 256, 256}, {0, 0, 256, 256});
  std::uint64_t last = 0;
  for (int i = 0; i < 60; ++i) {
    const auto frame = next(held.camera());
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->left.pixels, pattern(0, frame->left_window).pixels);
    last = frame->index;
  }
  EXPECT_GT(last, 59U) << "what was lost leaves gaps in the numbers";
  const AravisCounts counts = held.aravis().counts();
  EXPECT_GT(counts.left.lost_images + counts.right.lost_images, 0);
  EXPECT_GT(counts.left.missing_packets + counts.right.missing_packets, 0);
  EXPECT_GT(counts.unpaired_left + counts.unpaired_right, 0);
}

TEST(AravisStereoCamera, ACameraThatIsNotThereIsNamed) {
  AravisOptions options = optionsOf(CameraTrigger::kFreeRun);
  options.left.device = "127.0.0.3";
  try {
    const AravisStereoCamera camera(options);
    ADD_FAILURE() << "opened nothing";
  } catch (const DeviceError& e) {
    EXPECT_NE(std::string(e.what()).find("127.0.0.3"), std::string::npos) << e.what();
  }
}

TEST(AravisStereoCamera, CamerasThatGoAwayAreToldAndLetTheirHolderEnd) {
  auto server = std::make_unique<GigeServer>(GigeServerOptions{}, PatternSource(1.0 / kRateHz));
  AravisStereoCamera camera(optionsOf(CameraTrigger::kFreeRun));
  ASSERT_TRUE(next(camera));
  server.reset();
  bool told = false;
  for (int i = 0; i < 600 && !told; ++i) {
    camera.setFrameRate(kRateHz + i % 2);  // a question that nobody answers
    try {
      static_cast<void>(camera.grab(0.1));
    } catch (const DeviceError& e) {
      told = true;
      EXPECT_NE(std::string(e.what()).find("127.0.0."), std::string::npos) << e.what();
    }
  }
  EXPECT_TRUE(told);
}

TEST(GigeServer, AnAddressThatIsNotOursIsNamed) {
  try {
    const GigeServer server({"127.0.0.1", "192.0.2.1", 0.0}, PatternSource(0.02));
    ADD_FAILURE() << "served there";
  } catch (const DeviceError& e) {
    EXPECT_NE(std::string(e.what()).find("192.0.2.1"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace ringhook
