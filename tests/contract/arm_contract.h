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

  /// State periods from the first command after standing until commands act as they come.
  [[nodiscard]] virtual int periodsToWakeUp() const = 0;
  /// State periods until a command shows in the state, and within which a velocity is reached.
  [[nodiscard]] virtual int periodsToFollow() const = 0;
  /// State periods after the last command until the arm stands.
  [[nodiscard]] virtual int periodsToRest() const = 0;
};

using ArmMaker = std::unique_ptr<ArmUnderTest> (*)();

class ArmContract : public ::testing::TestWithParam<ArmMaker> {
 protected:
  ArmContract() : held_(GetParam()()) {}
  Arm& arm() { return held_->arm(); }
  /// Answers states with zeros until the arm is ready to follow.
  void wakeUp();
  /// Answers `periods` states with this velocity [rad/s]; the last state.
  ArmState drive(const JointVector& joint_velocity, int periods);
  /// Lets `periods` states pass without an answer; the last one.
  ArmState idle(int periods);
  /// The state in which the arm has come to rest after the last command.
  ArmState rest();
  ArmUnderTest& held() { return *held_; }
  /// Sends a velocity that may or may not be refused.
  void tryCommand(const JointVector& joint_velocity);

 private:
  std::unique_ptr<ArmUnderTest> held_;
};

}  // namespace ringhook
