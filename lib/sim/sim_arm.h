#pragma once

/// \file
/// The simulated cell's arm behind the Arm interface, in the same process and in virtual time:
/// waitState() moves the whole cell on by one state period of 4 ms. It reports the encoders, which
/// know nothing of the arm's kinematic errors, and differentiates them for the velocity. States may
/// be late: stamped when they arrive, a constant after the instant at which the encoders were read,
/// as those of a real controller are.

#include <memory>

#include "robot/arm.h"
#include "sim/cell_world.h"

namespace ringhook {

class SimArm : public Arm {
 public:
  static constexpr double kPeriod = 0.004;  ///< between state messages [s]

  /// The world must outlive the arm. \param state_delay_s of stamps behind the encoders' reading,
  /// not negative [s].
  explicit SimArm(CellWorld& world, double state_delay_s = 0.0);
  ~SimArm() override;

  [[nodiscard]] ArmState waitState() override;
  /// Throws DeviceError also while stopped, and if the period would end beyond a joint's range.
  void commandVelocity(const JointVector& joint_velocity) override;
  void stop() noexcept override;
  void rearm() override;
  [[nodiscard]] double commandDelay() const override { return 0.0; }
  void setGripper(bool closed) override;

 private:
  class Past;
  [[noreturn]] void refuse(const std::string& why);

  CellWorld& world_;
  std::shared_ptr<Past> past_;  ///< null if states are not late
  JointVector last_position_;   ///< of the state before [rad]
  bool stopped_ = false;
};

}  // namespace ringhook
