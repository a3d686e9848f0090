#pragma once

/// \file
/// Where calibration pictures and poses come from: a simulated cell in this process, a cell on a
/// network, or a folder of stored images. The wizard and `calibrate time` ask the same things of
/// all three; what one of them cannot do it says (canHoldBoard, canMoveArm, devices).
///
/// - **Simulated**: arm, cameras and world in virtual time, and in place of the integrator a board
///   that can be held anywhere. The belt stands, its hooks are out of view, nothing passes by. The
///   cameras stand a little off the nominal rig and the delays of cameras and arm differ with the
///   seed; the place never tells how much.
/// - **Network**: GigE Vision cameras and an RX60. Nothing moves before confirmMotion().
/// - **Stored**: pairs come in order until there are no more; the arm is where the folder's table
///   says that it was.
///
/// Safety: whatever ends a motion early, an exception of the step check (Ctrl-C), a device that
/// fails, a limit, stops the arm before it goes any further up.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/joints.h"
#include "core/outcome.h"
#include "core/pose.h"
#include "core/stereo_frame.h"
#include "cycle/cell_config.h"

namespace ringhook {

class Arm;
class StereoCamera;

/// Arm and cameras of a place that has them, for jobs in which both move at once.
struct PlaceDevices {
  Arm& arm;
  StereoCamera& camera;
  /// The cameras' stamps are mid-exposure on the arm's clock (the host's, by PTP); otherwise they
  /// are arrivals and lie behind mid-exposure by an unknown constant.
  bool stamps_are_mid_exposure = false;
  /// From the mid-exposure of the frame that was grabbed last to its arrival at the host [s];
  /// nothing if stamps are arrivals.
  std::function<std::optional<double>()> lateness_s;
};

class CalibrationPlace {
 public:
  CalibrationPlace() = default;
  CalibrationPlace(const CalibrationPlace&) = delete;
  CalibrationPlace& operator=(const CalibrationPlace&) = delete;
  virtual ~CalibrationPlace() = default;

  /// What it is, for a report: "simulated cell, scenario easy, seed 1".
  [[nodiscard]] virtual std::string name() const = 0;
  /// Called during waits and motions, some times a second or more; may throw to end them.
  void onStep(std::function<void()> check) { check_ = std::move(check); }

  /// Size of the full image: (0, 0, width, height) [px], the same for both cameras.
  [[nodiscard]] virtual Window fullImage() const = 0;
  /// A pair of full images exposed after this call, with the arm at rest; of a folder the next one,
  /// nothing at its end. Throws DeviceError, InputError for an unreadable file.
  [[nodiscard]] virtual std::optional<StereoFrame> takePair() = 0;

  /// Whether holdBoard works: true in the simulated cell alone.
  [[nodiscard]] virtual bool canHoldBoard() const { return false; }
  /// Holds the calibration board at fMt, or takes it away. Throws Error unless canHoldBoard().
  virtual void holdBoard(const std::optional<Pose>& fMt);

  /// Whether moveFlange works, perhaps after confirmMotion().
  [[nodiscard]] virtual bool canMoveArm() const { return false; }
  /// Whether somebody must have said yes to motion first.
  [[nodiscard]] virtual bool needsConfirmation() const { return false; }
  /// Somebody has: the arm may move from now on. Throws DeviceError if it does not permit motion.
  virtual void confirmMotion() {}

  /// The arm's joints, at rest; of a folder those of the pair that was taken last. Refuses "no arm
  /// here". Throws DeviceError.
  [[nodiscard]] virtual Outcome<ArmState> armState() = 0;
  /// fMe by the nominal kinematics, or as the folder tells; refuses as armState does.
  [[nodiscard]] virtual Outcome<Pose> flange();
  /// Moves the flange there on a straight way in joint space, from rest to rest, and tells where it
  /// came to rest. Refuses, without any motion, with the reason: out of reach, beyond a joint
  /// limit, in the way of floor, pedestal or belt, not confirmed. Throws DeviceError.
  [[nodiscard]] virtual Outcome<Pose> moveFlange(const Pose& fMe);
  /// Likewise to joint angles [rad].
  [[nodiscard]] virtual Outcome<Pose> moveJoints(const JointVector& target);

  /// Arm and cameras; null for stored images.
  [[nodiscard]] virtual const PlaceDevices* devices() { return nullptr; }

 protected:
  /// To be called in every wait and motion.
  void step() const {
    if (check_) {
      check_();
    }
  }

 private:
  std::function<void()> check_;
};

/// Chessboard in the simulated integrator's hands.
struct HeldBoard {
  int columns = 9;          ///< inner corners along x_t
  int rows = 6;             ///< inner corners along y_t
  double square_m = 0.030;  ///< [m]
};

struct SimulatedPlaceOptions {
  std::uint64_t seed = 1;  ///< of everything random
  HeldBoard board;
  /// From mid-exposure to arrival, and from the arm's sampling instant to its message [s]. Without:
  /// drawn by the seed, 6 to 14 ms and 1 to 7 ms.
  std::optional<double> camera_delay_s;
  std::optional<double> arm_delay_s;
};

/// Throws InputError for a cell file that is none of a simulated cell.
std::unique_ptr<CalibrationPlace> openSimulatedPlace(const CellConfig& cell,
                                                     const SimulatedPlaceOptions& options);

/// Throws InputError for a cell file that is none of a network, DeviceError for a device that
/// cannot be opened. The arm is only watched until confirmMotion().
std::unique_ptr<CalibrationPlace> openNetworkPlace(const CellConfig& cell);

/// A sequence folder (doc/formats.md), or folders left/ and right/ with as many images each, paired
/// in order of their names, and optionally robot.csv with a row for every pair. Throws InputError.
std::unique_ptr<CalibrationPlace> openStoredPlace(const std::filesystem::path& folder);

}  // namespace ringhook
