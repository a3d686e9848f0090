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
};

using StereoCameraMaker = std::unique_ptr<StereoCameraUnderTest> (*)();

class StereoCameraContract : public ::testing::TestWithParam<StereoCameraMaker> {
 protected:
  StereoCameraContract() : held_(GetParam()()) {}
  StereoCamera& camera() { return held_->camera(); }
  StereoCameraUnderTest& held() { return *held_; }
  /// The next `count` frames, fewer if the camera has finished or none comes within a second.
  std::vector<StereoFrame> take(std::size_t count);

 private:
  std::unique_ptr<StereoCameraUnderTest> held_;
};

}  // namespace ringhook
