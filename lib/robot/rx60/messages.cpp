#include "robot/rx60/messages.h"

#include <bit>
#include <cassert>
#include <optional>
#include <string>

namespace ringhook::rx60 {
namespace {

/// Puts values one after the other, little-endian.
class Writer {
 public:
  explicit Writer(std::span<std::byte> out) : out_(out) {}
  void put(std::uint8_t value) { out_[at_++] = std::byte{value}; }
  void put(std::int32_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    for (unsigned shift = 0; shift < 32; shift += 8) {
      out_[at_++] = static_cast<std::byte>((bits >> shift) & 0xFFU);
    }
  }
  void put(float value) { put(std::bit_cast<std::int32_t>(value)); }
  void put(PendantMode value) { put(static_cast<std::int32_t>(value)); }
  void put(VelocityKind value) { put(static_cast<std::int32_t>(value)); }
  template <std::size_t N>
  void put(const std::array<float, N>& values) {
    for (const float value : values) {
      put(value);
    }
  }
  [[nodiscard]] std::size_t size() const { return at_; }

 private:
  std::span<std::byte> out_;
  std::size_t at_ = 0;
};

/// Takes them back in the same order. Precondition: enough bytes, which exact sizes guarantee.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> in) : in_(in) {}
  void take(std::uint8_t& value) { value = std::to_integer<std::uint8_t>(in_[at_++]); }
  void take(std::int32_t& value) {
    std::uint32_t bits = 0;
    for (unsigned shift = 0; shift < 32; shift += 8) {
      bits |= std::to_integer<std::uint32_t>(in_[at_++]) << shift;
    }
    value = static_cast<std::int32_t>(bits);
  }
  void take(float& value) {
    std::int32_t bits = 0;
    take(bits);
    value = std::bit_cast<float>(bits);
  }
  void take(PendantMode& value) {
    std::int32_t raw = 0;
    take(raw);
    const bool known = raw == 1 || raw == 2;
    value = known ? static_cast<PendantMode>(raw) : PendantMode::kUnknown;
  }
  void take(VelocityKind& value) {
    std::int32_t raw = 0;
    take(raw);
    value = static_cast<VelocityKind>(raw);
  }
  template <std::size_t N>
  void take(std::array<float, N>& values) {
    for (float& value : values) {
      take(value);
    }
  }
  [[nodiscard]] bool done() const { return at_ == in_.size(); }

 private:
  std::span<const std::byte> in_;
  std::size_t at_ = 0;
};

/// The fields of every body in wire order, for writing (const body) and reading alike.
template <class B, class Each>
void fields(B& body, Each each) {
  using T = std::remove_const_t<B>;
  if constexpr (std::is_same_v<T, JointPosition>) {
    each(body.sequence, body.joints);
  } else if constexpr (std::is_same_v<T, JointTrajPt>) {
    each(body.sequence, body.joints, body.velocity, body.duration);
  } else if constexpr (std::is_same_v<T, RobotStatus>) {
    each(body.drives_powered, body.e_stopped, body.error_code, body.in_error, body.in_motion,
         body.mode, body.motion_possible);
  } else if constexpr (std::is_same_v<T, JointFeedback>) {
    each(body.robot_id, body.valid_fields, body.time, body.position, body.velocity,
         body.acceleration);
  } else if constexpr (std::is_same_v<T, SetDrivePower>) {
    each(body.on);
  } else if constexpr (std::is_same_v<T, WriteSingleIo>) {
    each(body.module, body.pin, body.state);
  } else if constexpr (std::is_same_v<T, VelocityCfg>) {
    each(body.kind, body.frame, body.tool, body.acceleration, body.velocity, body.translation_speed,
         body.rotation_speed);
  } else {
    static_assert(std::is_same_v<T, VelocityCmd>);
    each(body.sequence, body.velocity, body.kind);
  }
}

template <class B>
Body read(Reader reader) {
  B body;
  fields(body, [&](auto&... field) { (reader.take(field), ...); });
  assert(reader.done());
  return body;
}

Body readBody(MessageType type, std::span<const std::byte> bytes) {
  switch (type) {
    case MessageType::kJointPosition:
      return read<JointPosition>(Reader(bytes));
    case MessageType::kJointTrajPt:
      return read<JointTrajPt>(Reader(bytes));
    case MessageType::kStatus:
      return read<RobotStatus>(Reader(bytes));
    case MessageType::kJointFeedback:
      return read<JointFeedback>(Reader(bytes));
    case MessageType::kSetDrivePower:
      return read<SetDrivePower>(Reader(bytes));
    case MessageType::kWriteSingleIo:
      return read<WriteSingleIo>(Reader(bytes));
    case MessageType::kVelocityCfg:
      return read<VelocityCfg>(Reader(bytes));
    case MessageType::kVelocityCmd:
      break;
  }
  return read<VelocityCmd>(Reader(bytes));
}

struct Prefix {
  std::int32_t length = 0;
  std::int32_t type = 0;
  std::int32_t comm = 0;
  std::int32_t reply = 0;
};

Prefix readPrefix(std::span<const std::byte> bytes) {
  Prefix prefix;
  Reader reader(bytes);
  reader.take(prefix.length);
  reader.take(prefix.type);
  reader.take(prefix.comm);
  reader.take(prefix.reply);
  return prefix;
}

}  // namespace

std::optional<std::size_t> bodyBytes(std::int32_t type) {
  switch (static_cast<MessageType>(type)) {
    case MessageType::kJointPosition:
      return 44;
    case MessageType::kJointTrajPt:
      return 52;
    case MessageType::kStatus:
      return 28;
    case MessageType::kJointFeedback:
      return 132;
    case MessageType::kSetDrivePower:
      return 1;
    case MessageType::kWriteSingleIo:
      return 9;
    case MessageType::kVelocityCfg:
      return 68;
    case MessageType::kVelocityCmd:
      return 32;
  }
  return std::nullopt;
}

MessageType typeOf(const Body& body) {
  static constexpr std::array<MessageType, std::variant_size_v<Body>> kTypes = {
      MessageType::kJointPosition, MessageType::kJointTrajPt,   MessageType::kStatus,
      MessageType::kJointFeedback, MessageType::kSetDrivePower, MessageType::kWriteSingleIo,
      MessageType::kVelocityCfg,   MessageType::kVelocityCmd};
  return kTypes.at(body.index());
}

const char* nameOf(MessageType type) {
  switch (type) {
    case MessageType::kJointPosition:
      return "JOINT_POSITION";
    case MessageType::kJointTrajPt:
      return "JOINT_TRAJ_PT";
    case MessageType::kStatus:
      return "STATUS";
    case MessageType::kJointFeedback:
      return "JOINT_FEEDBACK";
    case MessageType::kSetDrivePower:
      return "SET_DRIVE_POWER";
    case MessageType::kWriteSingleIo:
      return "WRITE_SINGLE_IO";
    case MessageType::kVelocityCfg:
      return "VELOCITY_CFG";
    case MessageType::kVelocityCmd:
      break;
  }
  return "VELOCITY_CMD";
}

Frame encode(const Message& message) {
  Frame frame;
  const auto type = static_cast<std::int32_t>(typeOf(message.body));
  const std::size_t length = kHeaderBytes + *bodyBytes(type);
  Writer writer(frame.bytes_);
  writer.put(static_cast<std::int32_t>(length));
  writer.put(type);
  writer.put(static_cast<std::int32_t>(message.comm));
  writer.put(static_cast<std::int32_t>(message.reply));
  std::visit(
      [&](const auto& body) {
        fields(body, [&](const auto&... field) { (writer.put(field), ...); });
      },
      message.body);
  frame.size_ = writer.size();
  assert(frame.size_ == kLengthBytes + length);
  return frame;
}

Outcome<std::size_t> frameSize(std::span<const std::byte> prefix) {
  assert(prefix.size() >= kLengthBytes + kHeaderBytes);
  const Prefix told = readPrefix(prefix);
  const std::optional<std::size_t> body = bodyBytes(told.type);
  if (!body) {
    return Refusal{"a message of unknown type " + std::to_string(told.type) + " and length " +
                   std::to_string(told.length)};
  }
  const char* name = nameOf(static_cast<MessageType>(told.type));
  if (told.length != static_cast<std::int32_t>(kHeaderBytes + *body)) {
    return Refusal{std::string(name) + " of length " + std::to_string(told.length) +
                   " instead of " + std::to_string(kHeaderBytes + *body)};
  }
  if (told.comm < 1 || told.comm > 3) {
    return Refusal{std::string(name) + " with unknown comm type " + std::to_string(told.comm)};
  }
  if (told.reply < 0 || told.reply > 2) {
    return Refusal{std::string(name) + " with unknown reply code " + std::to_string(told.reply)};
  }
  return kLengthBytes + kHeaderBytes + *body;
}

Outcome<Message> decode(std::span<const std::byte> frame) {
  if (frame.size() < kLengthBytes + kHeaderBytes) {
    return Refusal{"a frame of " + std::to_string(frame.size()) + " bytes, too short for a header"};
  }
  const Outcome<std::size_t> size = frameSize(frame);
  if (!size) {
    return Refusal{size.reason()};
  }
  if (*size != frame.size()) {
    return Refusal{"a frame of " + std::to_string(frame.size()) + " bytes that announces " +
                   std::to_string(*size)};
  }
  const Prefix prefix = readPrefix(frame);
  return Message{
      static_cast<CommType>(prefix.comm), static_cast<ReplyCode>(prefix.reply),
      readBody(static_cast<MessageType>(prefix.type), frame.subspan(kLengthBytes + kHeaderBytes))};
}

WireJoints toWire(const JointVector& joints) {
  WireJoints wire{};
  for (int i = 0; i < 6; ++i) {
    wire.at(static_cast<std::size_t>(i)) = static_cast<float>(joints[i]);
  }
  return wire;
}

JointVector fromWire(const WireJoints& joints) {
  JointVector vector;
  for (int i = 0; i < 6; ++i) {
    vector[i] = static_cast<double>(joints.at(static_cast<std::size_t>(i)));
  }
  return vector;
}

}  // namespace ringhook::rx60
