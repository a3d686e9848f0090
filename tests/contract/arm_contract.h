#pragma once

/// \file
/// What every Arm must keep, whatever is behind it. A program instantiates the suite with makers of
/// its arms: INSTANTIATE_TEST_SUITE_P(Simulated, ArmContract, ::testing::Values(&makeSimArm)).

#include <gtest/gtest.h>

#include <memory>

#include "robot/arm.h"

namespace ringhook {

/// An arm, with all that keeps it alive, standing still well inside its joint ranges.
class ArmUnderTest {
 public:
  ArmUnderTest() = default;
  ArmUnderTest(const ArmUnderTest&) = delete;
  ArmUnderTest& operator=(const ArmUnderTest&) = delete;
  virtual ~ArmUnderTest() = default;
  virtual Arm& arm() = 0;
};

using ArmMaker = std::unique_ptr<ArmUnderTest> (*)();

class ArmContract : public ::testing::TestWithParam<ArmMaker> {
 protected:
  ArmContract() : held_(GetParam()()) {}
  Arm& arm() { return held_->arm(); }
  /// Answers `periods` states with this velocity [rad/s]; the last state.
  ArmState drive(const JointVector& joint_velocity, int periods);
  /// Lets `periods` states pass without an answer; the last one.
  ArmState idle(int periods);
  /// Sends a velocity that may or may not be refused.
  void tryCommand(const JointVector& joint_velocity);

 private:
  std::unique_ptr<ArmUnderTest> held_;
};

}  // namespace ringhook
