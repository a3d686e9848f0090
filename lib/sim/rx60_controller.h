#pragma once

/// \file
/// The RX60's controller with the open VAL3 server (staubli_val3_driver with the velocity
/// extension) as a client meets it, quirks included; doc/rx60.md tells the dialogue. No sockets and
/// no clock: bytes go in, frames come out, and tick() is 4 ms of the controller's life. In a tick
/// its tasks run in the order in which the server creates them:
///
/// 1. heartbeat: 1.0 s after the state socket connected, state may flow;
/// 2. streamer: JOINT_FEEDBACK (position now, velocity as last commanded, time an int32 in the
///    float's bytes), and a STATUS behind the 21st, 41st, ...;
/// 3. motion receiver: at most one message (rx60_receiver.h);
/// 4. motion task, of one of two modes. Velocity: the last command is copied, zeroed and applied
///    until the next tick. Trajectory: a waiting point is handed to movej, movej moves on. Both:
///    unless motion socket and state are there and no stop is asked for, motion is reset, what
///    waits is forgotten, and the stop is done with;
/// 5. mode switch, several ticks after the message that asked for it was acknowledged;
/// 6. system and I/O receivers: at most one message each.
///
/// As the server does:
/// - motion is refused (FAILURE) and stopped while the last STATUS *sent* said that it is not
///   possible, hence also before the first one, and up to 80 ms after it has become possible;
/// - a velocity that comes in trajectory mode, or during the switch, is acknowledged and kept: the
///   last one acts in velocity mode's first tick. A client is safe if it sends zeros.
/// Ours, where the server's source does not tell: the arm follows a velocity at once and at most at
/// its nominal speed; only joint velocities move it; a lost drive forgets a move under way; movej
/// takes one more move when the one before is done, so that points wait in the 10-deep queue.

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/time.h"
#include "robot/rx60/messages.h"
#include "sim/rx60_joint_move.h"
#include "sim/rx60_plant.h"
#include "sim/rx60_receiver.h"

namespace ringhook {

/// The server's TCP ports, 11000 to 11003 in this order.
enum class Rx60Socket { kMotion, kSystem, kState, kIo };
inline constexpr std::array<Rx60Socket, 4> kRx60Sockets = {Rx60Socket::kMotion, Rx60Socket::kSystem,
                                                           Rx60Socket::kState, Rx60Socket::kIo};
/// "motion" and the like.
const char* nameOf(Rx60Socket socket);

struct Rx60ControllerOptions {
  bool velocity_addon = true;  ///< else: no velocity messages, JOINT_POSITION at 50 Hz for state
  int switch_ticks = 5;  ///< from a message that switches the mode to the new mode's first tick
};

/// What happened so far.
struct Rx60Counts {
  std::int64_t ticks = 0;
  std::int64_t velocity_ticks = 0;  ///< ticks of the velocity task that applied a command
  std::int64_t missed_ticks = 0;    ///< of these, without a fresh command: the arm stood
  std::int64_t zero_ticks = 0;  ///< of these, with zero velocity, for want of a command or by it
  std::int64_t refused = 0;     ///< messages answered, or to be answered, with FAILURE
  std::int64_t flushes = 0;     ///< times that unknown input was thrown away
  std::map<rx60::MessageType, std::int64_t> received;
  std::map<rx60::MessageType, std::int64_t> sent;  ///< replies included
  double travel = 0.0;  ///< way of the joint that moved most in each tick, added up [rad]
};

class Rx60Controller {
 public:
  static constexpr double kTick = 0.004;          ///< [s]
  static constexpr std::size_t kQueueDepth = 10;  ///< trajectory points

  /// The plant must outlive the controller. Drives on, automatic mode, no one connected.
  explicit Rx60Controller(Rx60Plant& plant, const Rx60ControllerOptions& options = {});

  // What a line does.

  void connect(Rx60Socket socket);
  void disconnect(Rx60Socket socket);
  [[nodiscard]] bool connected(Rx60Socket socket) const { return at(socket).connected; }
  /// Bytes of a client's stream, cut anywhere. Ignored unless connected.
  void receive(Rx60Socket socket, std::span<const std::byte> bytes);
  /// Moves the plant on to `now`, then runs every task once. Call every 4 ms.
  void tick(Time now);
  /// Frames sent since the last call.
  std::vector<rx60::Frame> takeOutput(Rx60Socket socket);

  // What an operator, or a mishap, does.

  void pressEStop();                 ///< stands at once, drives off
  void releaseEStop();               ///< the drives stay off
  void setDrives(bool on);           ///< stays off while the emergency stop is pressed
  void setError(std::int32_t code);  ///< the motion task dies of it; 0: runs again
  void setPendantMode(rx60::PendantMode mode) { mode_switch_ = mode; }
  void refuseNextPoints(int count) { points_to_refuse_ = count; }

  // Read-outs.

  [[nodiscard]] const Rx60Counts& counts() const { return counts_; }
  /// What the arm was told in the last tick [rad/s].
  [[nodiscard]] const JointVector& commandedVelocity() const { return applied_; }
  [[nodiscard]] bool velocityMode() const { return velocity_mode_; }
  [[nodiscard]] bool switchingMode() const { return switching_to_.has_value(); }
  [[nodiscard]] bool drivesOn() const { return drives_on_; }
  [[nodiscard]] std::size_t waitingPoints() const { return points_.size(); }
  [[nodiscard]] std::size_t waitingBytes(Rx60Socket socket) const {
    return at(socket).receiver.waiting();
  }
  [[nodiscard]] rx60::RobotStatus status() const;  ///< now; the wire's may be 80 ms older

 private:
  struct Connection {
    bool connected = false;
    Rx60Receiver receiver;
    std::vector<rx60::Frame> output;
  };
  struct Move {
    Rx60JointMove path;
    double time_s = 0.0;  ///< since its start
  };
  [[nodiscard]] Connection& at(Rx60Socket socket) {
    return connections_.at(static_cast<std::size_t>(socket));
  }
  [[nodiscard]] const Connection& at(Rx60Socket socket) const {
    return connections_.at(static_cast<std::size_t>(socket));
  }
  void send(Rx60Socket socket, const rx60::Message& message);

  // tasks
  void heartbeat();
  void stream(Time now);
  void receiveOne(Rx60Socket socket);
  void runMotion();
  void applyVelocityCommand();
  void followPoints();
  void switchMode();

  // messages
  bool take(const rx60::Message& message);
  bool takeMotion(const rx60::Body& body);
  bool takePoint(const rx60::JointTrajPt& point);
  void takeVelocity(const rx60::VelocityCmd& command);
  bool takeOutputWrite(const rx60::WriteSingleIo& write);

  void resetMotion();
  void apply(const JointVector& velocity);
  [[nodiscard]] bool powered() const { return drives_on_ && !e_stopped_; }

  Rx60Plant& plant_;
  Rx60ControllerOptions options_;
  std::vector<Connection> connections_;
  Rx60Counts counts_;

  // state stream
  int state_ticks_ = 0;  ///< since the state socket connected
  bool state_flows_ = false;
  int throttle_ = 0;               ///< feedbacks since the last STATUS
  rx60::RobotStatus last_status_;  ///< the last one sent

  // motion
  bool velocity_mode_ = false;
  bool stop_ = false;
  std::optional<rx60::MessageType> mode_event_;  ///< a message that may ask for another mode
  std::optional<bool> switching_to_;             ///< velocity mode or not
  int switch_ticks_left_ = 0;
  rx60::VelocityCfg configuration_;
  JointVector command_ = JointVector::Zero();  ///< for the next velocity tick [rad/s]
  bool command_fresh_ = false;
  JointVector applied_ = JointVector::Zero();  ///< [rad/s]
  std::deque<rx60::JointTrajPt> points_;       ///< at most kQueueDepth
  std::optional<Move> move_;

  // cabinet
  bool drives_on_ = true;
  bool e_stopped_ = false;
  std::int32_t error_code_ = 0;
  rx60::PendantMode mode_switch_ = rx60::PendantMode::kAutomatic;
  int points_to_refuse_ = 0;
};

}  // namespace ringhook
