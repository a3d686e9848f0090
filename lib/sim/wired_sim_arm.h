#pragma once

/// \file
/// The simulated cell's arm as a real one is met: the RX60's client speaks its protocol to the
/// simulated controller, which drives the cell's arm, all in virtual time. The whole task can so be
/// run through limiter, link and controller, and every run is the same.

#include <memory>

#include "robot/rx60/rx60_arm.h"
#include "sim/cell_world.h"
#include "sim/rx60_controller.h"

namespace ringhook {

class WiredSimArm : public Arm {
 public:
  /// Connects, which takes 1.1 s of the world's time. The world must outlive the arm and be moved
  /// on by it alone. Throws DeviceError as Rx60Arm does.
  explicit WiredSimArm(CellWorld& world, std::uint64_t seed = 1);

  [[nodiscard]] ArmState waitState() override { return arm_.waitState(); }
  void commandVelocity(const JointVector& joint_velocity) override {
    arm_.commandVelocity(joint_velocity);
  }
  void stop() noexcept override { arm_.stop(); }
  void rearm() override { arm_.rearm(); }
  [[nodiscard]] double commandDelay() const override { return arm_.commandDelay(); }
  void setGripper(bool closed) override { arm_.setGripper(closed); }

  [[nodiscard]] const Rx60Controller& controller() const { return controller_; }
  [[nodiscard]] rx60::LinkReport report() const { return arm_.report(); }

 private:
  CellPlant plant_;
  Rx60Controller controller_;
  Rx60Arm arm_;
};

}  // namespace ringhook
