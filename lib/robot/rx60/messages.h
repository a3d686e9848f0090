#pragma once

/// \file
/// What an RX60's controller and its client say to each other: ROS-Industrial simple_message with
/// the velocity extension, as the open VAL3 server speaks it (staubli_val3_driver, master and pull
/// request 36; doc/rx60.md tells the dialogue).
///
/// A frame is little-endian: int32 length of what follows it, int32 type, int32 comm, int32 reply,
/// then a body whose size its type fixes. Reals are float32, joints always ten slots, the six of
/// the arm first. A reply repeats the type and the size of its request; its body is not to be
/// trusted beyond the sequence number. Encoding and decoding allocate nothing, except for the words
/// of a refusal.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "core/joints.h"
#include "core/outcome.h"

namespace ringhook::rx60 {

enum class MessageType : std::int32_t {
  kJointPosition = 10,
  kJointTrajPt = 11,
  kStatus = 13,
  kJointFeedback = 15,
  kSetDrivePower = 1610,
  kWriteSingleIo = 1621,
  kVelocityCfg = 1640,
  kVelocityCmd = 1641,
};
enum class CommType : std::int32_t { kTopic = 1, kRequest = 2, kReply = 3 };
enum class ReplyCode : std::int32_t { kNone = 0, kSuccess = 1, kFailure = 2 };

/// Sequence numbers with a meaning of their own.
inline constexpr std::int32_t kStopSequence = -4;

using WireJoints = std::array<float, 10>;  ///< [rad] or [rad/s]; slots 7 to 10 are not used

/// Where the arm is, from a server without the velocity extension (50 Hz).
struct JointPosition {
  std::int32_t sequence = 0;
  WireJoints joints{};  ///< [rad]
  bool operator==(const JointPosition&) const = default;
};

/// A point to move to in joint space.
struct JointTrajPt {
  std::int32_t sequence = 0;
  WireJoints joints{};    ///< [rad]
  float velocity = 0.0F;  ///< share of the nominal speed, 0 to 1
  float duration = 0.0F;  ///< [s]; the server does not look at it
  bool operator==(const JointTrajPt&) const = default;
};

enum class PendantMode : std::int32_t { kUnknown = -1, kManual = 1, kAutomatic = 2 };

/// How the controller is; flags are 0 or 1.
struct RobotStatus {
  std::int32_t drives_powered = 0;
  std::int32_t e_stopped = 0;
  std::int32_t error_code = 0;
  std::int32_t in_error = 0;
  std::int32_t in_motion = 0;
  PendantMode mode = PendantMode::kUnknown;
  std::int32_t motion_possible = 0;
  bool operator==(const RobotStatus&) const = default;
};

/// Where the arm is, from a server with the velocity extension (250 Hz).
struct JointFeedback {
  std::int32_t robot_id = 0;
  std::int32_t valid_fields = 0;  ///< bits: 1 time, 2 position, 4 velocity, 8 acceleration
  float time = 0.0F;              ///< [s]; the server writes an integer's bits here: not usable
  WireJoints position{};          ///< [rad]
  WireJoints velocity{};          ///< the commanded one, not measured [rad/s]
  WireJoints acceleration{};      ///< [rad/s^2]; the server sends zeros
  bool operator==(const JointFeedback&) const = default;
};
inline constexpr std::int32_t kPositionValid = 2;

struct SetDrivePower {
  std::uint8_t on = 0;
  bool operator==(const SetDrivePower&) const = default;
};

struct WriteSingleIo {
  std::int32_t module = 0;
  std::int32_t pin = 0;
  std::uint8_t state = 0;
  bool operator==(const WriteSingleIo&) const = default;
};

enum class VelocityKind : std::int32_t { kJoint = 1, kBaseFrame = 2, kToolFrame = 3 };

/// Asks for velocity mode.
struct VelocityCfg {
  VelocityKind kind = VelocityKind::kJoint;
  std::array<float, 6> frame{};    ///< x y z [m], rx ry rz [rad]: reference of kBaseFrame
  std::array<float, 6> tool{};     ///< the same: tool on the flange
  float acceleration = 1.0F;       ///< share of nominal, 0 to 1
  float velocity = 1.0F;           ///< share of nominal, 0 to 1
  float translation_speed = 0.0F;  ///< greatest [m/s]
  float rotation_speed = 0.0F;     ///< greatest [rad/s]
  bool operator==(const VelocityCfg&) const = default;
};

/// One velocity, for one controller tick of 4 ms.
struct VelocityCmd {
  std::int32_t sequence = 0;        ///< kStopSequence stops and empties what is queued
  std::array<float, 6> velocity{};  ///< [rad/s] for kJoint, else [m/s] and [rad/s]
  VelocityKind kind = VelocityKind::kJoint;
  bool operator==(const VelocityCmd&) const = default;
};

using Body = std::variant<JointPosition, JointTrajPt, RobotStatus, JointFeedback, SetDrivePower,
                          WriteSingleIo, VelocityCfg, VelocityCmd>;

struct Message {
  CommType comm = CommType::kTopic;
  ReplyCode reply = ReplyCode::kNone;
  Body body;
  bool operator==(const Message&) const = default;
};

inline constexpr std::size_t kLengthBytes = 4;   ///< of the leading length
inline constexpr std::size_t kHeaderBytes = 12;  ///< type, comm, reply
/// The longest frame is JOINT_FEEDBACK's.
inline constexpr std::size_t kMaxFrameBytes = kLengthBytes + kHeaderBytes + 132;

MessageType typeOf(const Body& body);

/// Bytes of the body of a type as it stands in a header; nothing for one that is not spoken here.
std::optional<std::size_t> bodyBytes(std::int32_t type);

/// "VELOCITY_CMD" and the like.
const char* nameOf(MessageType type);

/// An encoded frame, length and all.
class Frame {
 public:
  [[nodiscard]] std::span<const std::byte> bytes() const { return {bytes_.data(), size_}; }

 private:
  friend Frame encode(const Message& message);
  std::array<std::byte, kMaxFrameBytes> bytes_{};
  std::size_t size_ = 0;
};
Frame encode(const Message& message);

/// The bytes that a frame's first sixteen announce, the length field included: refused, with words
/// that say what came, unless type, comm, reply and length are known and belong together.
/// Precondition: prefix holds at least kLengthBytes + kHeaderBytes bytes.
Outcome<std::size_t> frameSize(std::span<const std::byte> prefix);

/// The message in exactly one whole frame; refused as frameSize() refuses, and if the size differs.
Outcome<Message> decode(std::span<const std::byte> frame);

/// A joint vector in ten slots and back [rad] or [rad/s].
WireJoints toWire(const JointVector& joints);
JointVector fromWire(const WireJoints& joints);

}  // namespace ringhook::rx60
