#include "stereo_camera_contract.h"

#include <cmath>

#include "core/error.h"

namespace ringhook {

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(StereoCameraContract);

std::vector<StereoFrame> StereoCameraContract::take(std::size_t count) {
  std::vector<StereoFrame> frames;
  constexpr double kStep = 0.002;
  const double patience = held_->realTime() ? 60.0 : 1.0;
  double waited = 0.0;
  while (frames.size() < count && waited < patience) {
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

bool StereoCameraContract::obeys(const Window& got, const Window& asked) {
  return held_->realTime() ? intersect(got, asked) == asked : got == asked;
}

StereoFrame StereoCameraContract::takeWith(const Window& left, const Window& right) {
  const std::size_t patience = held_->realTime() ? 500 : 3;
  StereoFrame last;
  for (std::size_t i = 0; i < patience; ++i) {
    auto frames = take(1);
    if (frames.empty()) {
      break;
    }
    last = std::move(frames.front());
    if (obeys(last.left_window, left) && obeys(last.right_window, right)) {
      break;
    }
  }
  return last;
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

/// How many periods lie between two frames, which must be a whole number of them.
double periodsBetween(const StereoFrame& a, const StereoFrame& b, double rate_hz) {
  const double periods = (b.time - a.time) * rate_hz;
  EXPECT_NEAR(periods, std::round(periods), 0.001 * rate_hz);
  return std::round(periods);
}

TEST_P(StereoCameraContract, FramesComeInOrderOfTimeAndAreNumbered) {
  const auto frames = take(4);
  ASSERT_GE(frames.size(), 2U);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_GT(frames[i].time, frames[i - 1].time);
    EXPECT_GT(frames[i].index, frames[i - 1].index);
    EXPECT_TRUE(frames[i].index == frames[i - 1].index + 1 || held().realTime());
    const double periods = periodsBetween(frames[i - 1], frames[i], held().rateHz());
    EXPECT_TRUE(periods == 1.0 || held().realTime());
  }
  EXPECT_TRUE(frames.front().index == 0U || held().realTime());
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
  const StereoFrame frame = takeWith(left, right);
  EXPECT_EQ(obeys(frame.left_window, left), held().chooses());
  EXPECT_EQ(obeys(frame.right_window, right), held().chooses());
  EXPECT_TRUE(fits(frame.left, frame.left_window, full));
  if (held().chooses()) {
    EXPECT_LT(frame.left_window.width * frame.left_window.height, full.width * full.height / 4);
  }
}

TEST_P(StereoCameraContract, WindowsMoveFromFrameToFrame) {
  const Window full = camera().fullImage();
  for (int step = 0; step < 5 && held().chooses(); ++step) {
    const Window left{10 + 20 * step, 30 + 10 * step, full.width / 8, full.height / 8};
    const Window right{40 + 20 * step, 30 + 10 * step, full.width / 8, full.height / 8};
    camera().setWindows(left, right);
    const StereoFrame frame = takeWith(left, right);
    EXPECT_TRUE(obeys(frame.left_window, left)) << step;
    EXPECT_TRUE(obeys(frame.right_window, right)) << step;
    EXPECT_TRUE(fits(frame.right, frame.right_window, full));
  }
}

TEST_P(StereoCameraContract, WindowsAreClippedToTheFullImage) {
  const Window full = camera().fullImage();
  const Window over{full.width - 20, -10, 100, 40};
  const Window clipped{full.width - 20, 0, 20, 30};
  camera().setWindows(over, over);
  const StereoFrame frame = takeWith(clipped, clipped);
  EXPECT_TRUE(fits(frame.left, frame.left_window, full));
  EXPECT_EQ(obeys(frame.left_window, clipped), held().chooses());
}

TEST_P(StereoCameraContract, AnEmptyWindowMeansTheFullImage) {
  camera().setWindows({10, 10, 50, 50}, {10, 10, 50, 50});
  camera().setWindows({}, {});
  const Window full = camera().fullImage();
  const StereoFrame frame = takeWith(full, full);
  if (held().chooses()) {
    EXPECT_EQ(frame.left_window, full);
    EXPECT_EQ(frame.right_window, full);
  }
}

TEST_P(StereoCameraContract, RateActsOnLaterExposuresAndNotOnARecording) {
  camera().setWindows({0, 0, 32, 32}, {0, 0, 32, 32});
  camera().setFrameRate(0.5 * held().rateHz());
  const double expected = held().chooses() ? 2.0 : 1.0;
  const std::size_t patience = held().realTime() ? 500 : 4;
  auto before = take(1);
  double periods = 0.0;
  for (std::size_t i = 1; i < patience && !before.empty(); ++i) {
    auto next = take(1);
    ASSERT_FALSE(next.empty());
    periods = periodsBetween(before.front(), next.front(), held().rateHz());
    before = std::move(next);
    if (held().realTime() && periods == expected) {
      break;
    }
  }
  EXPECT_EQ(periods, expected);
}

TEST_P(StereoCameraContract, ARateThatIsNotPositiveIsRefused) {
  EXPECT_THROW(camera().setFrameRate(0.0), DeviceError);
  EXPECT_THROW(camera().setFrameRate(-5.0), DeviceError);
  EXPECT_THROW(camera().setFrameRate(std::nan("")), DeviceError);
}

}  // namespace
}  // namespace ringhook
