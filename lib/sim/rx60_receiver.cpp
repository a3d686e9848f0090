#include "sim/rx60_receiver.h"

#include <cstdint>

namespace ringhook {
namespace {

using rx60::MessageType;

constexpr std::size_t kTypeAt = 4;  // in a frame [bytes]
constexpr std::size_t kCommAt = 8;
constexpr std::size_t kReplyAt = 12;

std::int32_t int32At(const std::vector<std::byte>& frame, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    bits |= std::to_integer<std::uint32_t>(frame[at + i]) << (8 * i);
  }
  return static_cast<std::int32_t>(bits);
}

/// \param value below 256.
void setInt32(std::vector<std::byte>& frame, std::size_t at, std::size_t value) {
  frame[at] = static_cast<std::byte>(value);
  frame[at + 1] = frame[at + 2] = frame[at + 3] = std::byte{0};
}

/// Bytes of the body of a type that a client may send; 0 for one that the server does not know.
std::size_t bodyFromClient(std::int32_t type, bool velocity_addon) {
  const auto is = [type](MessageType other) { return type == static_cast<std::int32_t>(other); };
  const bool velocity = is(MessageType::kVelocityCfg) || is(MessageType::kVelocityCmd);
  const bool known = is(MessageType::kJointTrajPt) || is(MessageType::kSetDrivePower) ||
                     is(MessageType::kWriteSingleIo) || (velocity && velocity_addon);
  return known ? rx60::bodyBytes(type).value_or(0) : 0;
}

}  // namespace

void Rx60Receiver::push(std::span<const std::byte> bytes) {
  input_.insert(input_.end(), bytes.begin(), bytes.end());
}

void Rx60Receiver::clear() {
  input_.clear();
  frame_.clear();
  part_ = Part::kPrefix;
}

std::size_t Rx60Receiver::partBytes() const {
  switch (part_) {
    case Part::kPrefix:
      return rx60::kLengthBytes;
    case Part::kHeader:
      return rx60::kHeaderBytes;
    case Part::kBody:
      break;
  }
  return bodyFromClient(int32At(frame_, kTypeAt), velocity_addon_);
}

bool Rx60Receiver::takePart() {
  const std::size_t wanted = partBytes();
  if (wanted == 0) {  // the body of an unknown type
    ++flushes_;
    clear();
    return false;
  }
  if (input_.empty()) {  // the server starts over instead of waiting for the next part
    clear();
    return false;
  }
  if (input_.size() < wanted) {
    return false;
  }
  const auto end = input_.begin() + static_cast<std::ptrdiff_t>(wanted);
  frame_.insert(frame_.end(), input_.begin(), end);
  input_.erase(input_.begin(), end);
  return true;
}

std::optional<rx60::Message> Rx60Receiver::next() {
  if (part_ == Part::kPrefix) {
    if (!takePart()) {
      return std::nullopt;
    }
    part_ = Part::kHeader;
  }
  if (part_ == Part::kHeader) {
    if (!takePart()) {
      return std::nullopt;
    }
    part_ = Part::kBody;
  }
  if (!takePart()) {
    return std::nullopt;
  }
  // What the server does not look at is made lawful, so that the strict decoder accepts it.
  const bool request = int32At(frame_, kCommAt) == static_cast<int>(rx60::CommType::kRequest);
  setInt32(frame_, 0, frame_.size() - rx60::kLengthBytes);
  setInt32(frame_, kCommAt, request ? 2 : 1);
  setInt32(frame_, kReplyAt, 0);
  const Outcome<rx60::Message> message = rx60::decode(frame_);
  frame_.clear();
  part_ = Part::kPrefix;
  return *message;
}

}  // namespace ringhook
