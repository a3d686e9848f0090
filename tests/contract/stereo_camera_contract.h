#pragma once

/// \file
/// What every StereoCamera must keep, whatever is behind it. A program instantiates the suite with
/// makers of its cameras:
/// INSTANTIATE_TEST_SUITE_P(Simulated, StereoCameraContract, ::testing::Values(&makeSimCamera)).

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "camera/stereo_camera.h"

namespace ringhook {

/// A camera that has just been opened, with all that keeps it alive.
class StereoCameraUnderTest {
 public:
  StereoCameraUnderTest() = default;
  StereoCameraUnderTest(const StereoCameraUnderTest&) = delete;
  StereoCameraUnderTest& operator=(const StereoCameraUnderTest&) = delete;
  virtual ~StereoCameraUnderTest() = default;
  virtual StereoCamera& camera() = 0;
  /// Lets `seconds` pass for the camera (virtual time); a recording needs none.
  virtual void pass(double seconds) = 0;
  /// Whether windows and rate can be chosen; a recording delivers what it has.
  [[nodiscard]] virtual bool chooses() const = 0;
  /// Pairs a second it was opened with [Hz].
  [[nodiscard]] virtual double rateHz() const = 0;
  /// A device in real time: a busy host may make it leave exposures out, settings take some
  /// exposures to act, and regions may be larger than asked.
  [[nodiscard]] virtual bool realTime() const { return false; }
};

using StereoCameraMaker = std::unique_ptr<StereoCameraUnderTest> (*)();

class StereoCameraContract : public ::testing::TestWithParam<StereoCameraMaker> {
 protected:
  StereoCameraContract() : held_(GetParam()()) {}
  StereoCamera& camera() { return held_->camera(); }
  StereoCameraUnderTest& held() { return *held_; }
  /// The next `count` frames, fewer if the camera has finished or none comes for long.
  std::vector<StereoFrame> take(std::size_t count);
  /// The first frame that was taken with these windows, as far as this camera can choose them; the
  /// last one seen if that never comes.
  StereoFrame takeWith(const Window& left, const Window& right);
  /// Whether the frame's window is the asked one, or holds it where the camera may read more.
  bool obeys(const Window& got, const Window& asked);

 private:
  std::unique_ptr<StereoCameraUnderTest> held_;
};

}  // namespace ringhook
