#include "stereo_camera_contract.h"

#include <cmath>

#include "core/error.h"

namespace ringhook {

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(StereoCameraContract);

std::vector<StereoFrame> StereoCameraContract::take(std::size_t count) {
  std::vector<StereoFrame> frames;
  constexpr double kStep = 0.002;
  double waited = 0.0;
  while (frames.size() < count && waited < 1.0) {
    if (auto frame = camera().grab(kStep)) {
      frames.push_back(std::move(*frame));
      waited = 0.0;
    } else if (camera().finished()) {
      break;
    } else {
      held_->pass(kStep);
      waited += kStep;
    }
  }
  return frames;
}

namespace {

bool fits(const GrayImage& image, const Window& window, const Window& full) {
  return image.width == window.width && image.height == window.height &&
         image.pixels.size() ==
             static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height) &&
         intersect(window, full) == window;
}

TEST_P(StereoCameraContract, FullImageStartsAtTheOriginAndIsNotEmpty) {
  const Window full = camera().fullImage();
  EXPECT_EQ(full.x, 0);
  EXPECT_EQ(full.y, 0);
  EXPECT_FALSE(full.empty());
}

TEST_P(StereoCameraContract, FramesComeInOrderOfTimeAndAreNumbered) {
  const auto frames = take(4);
  ASSERT_GE(frames.size(), 2U);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_GT(frames[i].time, frames[i - 1].time);
    EXPECT_EQ(frames[i].index, frames[i - 1].index + 1);
    EXPECT_NEAR(frames[i].time - frames[i - 1].time, 1.0 / held().rateHz(), 0.001);
  }
  EXPECT_EQ(frames.front().index, 0U);
}

TEST_P(StereoCameraContract, ImagesAreThePixelsOfTheirWindows) {
  for (const StereoFrame& frame : take(2)) {
    EXPECT_TRUE(fits(frame.left, frame.left_window, camera().fullImage()));
    if (!frame.right.empty()) {
      EXPECT_TRUE(fits(frame.right, frame.right_window, camera().fullImage()));
    }
  }
}

TEST_P(StereoCameraContract, ChosenWindowsActOnLaterFrames) {
  const Window full = camera().fullImage();
  const Window left{full.width / 4, full.height / 4, full.width / 8, full.height / 8};
  const Window right{full.width / 2, full.height / 3, full.width / 8, full.height / 6};
  camera().setWindows(left, right);
  const auto frames = take(3);
  ASSERT_FALSE(frames.empty());
  const StereoFrame& last = frames.back();
  EXPECT_EQ(last.left_window == left, held().chooses());
  EXPECT_EQ(last.right_window == right, held().chooses());
  EXPECT_TRUE(fits(last.left, last.left_window, full));
}

TEST_P(StereoCameraContract, WindowsAreClippedToTheFullImage) {
  const Window full = camera().fullImage();
  const Window over{full.width - 20, -10, 100, 40};
  camera().setWindows(over, over);
  for (const StereoFrame& frame : take(3)) {
    EXPECT_TRUE(fits(frame.left, frame.left_window, full));
    if (held().chooses() && frame.index >= 1) {
      EXPECT_EQ(frame.left_window, (Window{full.width - 20, 0, 20, 30}));
    }
  }
}

TEST_P(StereoCameraContract, AnEmptyWindowMeansTheFullImage) {
  camera().setWindows({10, 10, 50, 50}, {10, 10, 50, 50});
  camera().setWindows({}, {});
  const auto frames = take(1);
  ASSERT_FALSE(frames.empty());
  if (held().chooses()) {
    EXPECT_EQ(frames.front().left_window, camera().fullImage());
    EXPECT_EQ(frames.front().right_window, camera().fullImage());
  }
}

TEST_P(StereoCameraContract, RateActsFromTheNextExposureOnAndNotOnARecording) {
  camera().setWindows({0, 0, 32, 32}, {0, 0, 32, 32});
  camera().setFrameRate(0.5 * held().rateHz());
  const auto frames = take(4);
  ASSERT_EQ(frames.size(), 4U);
  const double periods = held().chooses() ? 2.0 : 1.0;
  EXPECT_NEAR(frames[3].time - frames[2].time, periods / held().rateHz(), 0.001);
}

TEST_P(StereoCameraContract, ARateThatIsNotPositiveIsRefused) {
  EXPECT_THROW(camera().setFrameRate(0.0), DeviceError);
  EXPECT_THROW(camera().setFrameRate(-5.0), DeviceError);
  EXPECT_THROW(camera().setFrameRate(std::nan("")), DeviceError);
}

}  // namespace
}  // namespace ringhook
