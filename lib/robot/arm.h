#pragma once

/// \file
/// The one interface of every arm: simulated in process, or an RX60 over its protocol. The arm's
/// state messages (250 Hz) clock the control loop: wait for a state, answer it with exactly one
/// velocity command. A command ends by itself: after one state period in the simulated arm, after
/// a short hold and ramp in the RX60's client; without the next one the arm stands still.

#include "core/joints.h"

namespace ringhook {

class Arm {
 public:
  Arm() = default;
  Arm(const Arm&) = delete;
  Arm& operator=(const Arm&) = delete;
  virtual ~Arm() = default;

  /// Waits for the next state message; in virtual time this advances the world by one period.
  /// Throws DeviceError when the link or the arm is lost.
  [[nodiscard]] virtual ArmState waitState() = 0;

  /// Joint velocities [rad/s] from now on, until the next command or the end of the hold. Values
  /// that are not finite or exceed the arm's speed limits are refused: the arm stops and
  /// DeviceError is thrown.
  virtual void commandVelocity(const JointVector& joint_velocity) = 0;

  /// Stands still at once and accepts no motion until rearm(). Never throws: it is the last thing
  /// that still works.
  virtual void stop() noexcept = 0;

  /// Explicit permission to move again after stop() or a fault.
  virtual void rearm() = 0;

  /// From a state's instant until the command that answers it begins to act, as far as the way of
  /// commanding is the reason [s]. Network and drives come on top (the cell file's delay_ms).
  [[nodiscard]] virtual double commandDelay() const = 0;

  /// Opens (false) or closes (true) the gripper; returns at once.
  virtual void setGripper(bool closed) = 0;
};

}  // namespace ringhook
