#pragma once

/// \file
/// What a simulated RX60 controller drives: an arm that turns with the joint velocities it is told
/// and then stands still, and digital outputs. Time moves only in advanceTo().
///
/// KinematicPlant integrates the velocities and nothing else; CellPlant hands them to the simulated
/// cell, so that the whole cell lives on the controller's time.

#include <map>
#include <utility>

#include "core/joints.h"
#include "core/time.h"
#include "sim/cell_world.h"

namespace ringhook {

class Rx60Plant {
 public:
  Rx60Plant() = default;
  Rx60Plant(const Rx60Plant&) = delete;
  Rx60Plant& operator=(const Rx60Plant&) = delete;
  virtual ~Rx60Plant() = default;

  /// Moves on until `time`; nothing if that is past.
  virtual void advanceTo(Time time) = 0;
  /// Encoder reading at this instant [rad].
  [[nodiscard]] virtual JointVector position() const = 0;
  /// Joint velocities [rad/s] from now on for duration_s [s], then standstill. A joint stops at its
  /// limit. Precondition: finite.
  virtual void setVelocity(const JointVector& joint_velocity, double duration_s) = 0;
  virtual void setOutput(int module, int pin, bool state) = 0;
};

/// An arm without masses: follows every velocity at once, within the RX60's joint ranges.
class KinematicPlant : public Rx60Plant {
 public:
  /// \param position joints at time zero [rad].
  explicit KinematicPlant(JointVector position = JointVector::Zero());

  void advanceTo(Time time) override;
  [[nodiscard]] JointVector position() const override { return position_; }
  void setVelocity(const JointVector& joint_velocity, double duration_s) override;
  void setOutput(int module, int pin, bool state) override { outputs_[{module, pin}] = state; }

  /// The last state written; false before the first.
  [[nodiscard]] bool output(int module, int pin) const;

 private:
  Time time_;
  JointVector position_;                        ///< [rad]
  JointVector velocity_ = JointVector::Zero();  ///< until velocity_end_ [rad/s]
  Time velocity_end_;
  std::map<std::pair<int, int>, bool> outputs_;  ///< by module and pin
};

/// The digital output that closes the gripper.
struct GripperOutput {
  int module = 2;  ///< the arm's own valves, VALVE_OUT of the VAL3 server
  int pin = 0;
};

/// The arm of the simulated cell. The world's time is the controller's time.
class CellPlant : public Rx60Plant {
 public:
  /// The world must outlive the plant.
  explicit CellPlant(CellWorld& world, const GripperOutput& gripper = {});

  void advanceTo(Time time) override;
  [[nodiscard]] JointVector position() const override;
  void setVelocity(const JointVector& joint_velocity, double duration_s) override;
  void setOutput(int module, int pin, bool state) override;

 private:
  CellWorld& world_;
  GripperOutput gripper_;
};

}  // namespace ringhook
