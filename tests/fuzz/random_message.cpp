#include "fuzz/random_message.h"

namespace ringhook::fuzz {
namespace {

template <std::size_t N>
std::array<float, N> reals(Script& script) {
  std::array<float, N> values{};
  const bool tame = script.byte() % 4 != 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(N, 6); ++i) {
    values.at(i) = tame ? static_cast<float>(2.0 * script.share()) : script.real();
  }
  return values;
}

std::int32_t sequence(Script& script) {
  return static_cast<std::int32_t>(script.byte() % 8) + rx60::kStopSequence;
}

rx60::Body motionBody(Script& script, std::size_t kind) {
  if (kind == 0) {
    rx60::JointTrajPt point;
    point.sequence = sequence(script);
    point.joints = reals<10>(script);
    point.velocity = script.choice(4) == 0 ? script.real() : 1.0F;
    return point;
  }
  if (kind == 1) {
    rx60::VelocityCfg configuration;
    configuration.kind = static_cast<rx60::VelocityKind>(1 + script.choice(4) % 4);
    configuration.velocity = script.choice(4) == 0 ? script.real() : 1.0F;
    return configuration;
  }
  rx60::VelocityCmd command;
  command.sequence = sequence(script);
  command.velocity = reals<6>(script);
  command.kind = static_cast<rx60::VelocityKind>(1 + script.choice(8) / 6);
  return command;
}

rx60::Body body(Script& script) {
  const std::size_t kind = script.choice(8);
  switch (kind) {
    case 3:
      return rx60::SetDrivePower{script.byte()};
    case 4:
      return rx60::WriteSingleIo{script.byte() % 8, script.byte() % 20 - 1, script.byte()};
    case 5:
      return rx60::JointPosition{sequence(script), reals<10>(script)};
    case 6: {
      rx60::RobotStatus status;
      status.drives_powered = script.byte() % 2;
      status.e_stopped = script.byte() % 2;
      status.motion_possible = script.byte() % 2;
      return status;
    }
    case 7: {
      rx60::JointFeedback feedback;
      feedback.valid_fields = script.byte();
      feedback.position = reals<10>(script);
      return feedback;
    }
    default:
      return motionBody(script, kind);
  }
}

}  // namespace

rx60::Message scriptedMessage(Script& script) {
  rx60::Message message;
  const std::uint8_t how = script.byte();
  message.comm = static_cast<rx60::CommType>(how % 4 == 0 ? 1 : how % 4);
  message.reply = static_cast<rx60::ReplyCode>(how / 4 % 3);
  message.body = body(script);
  return message;
}

std::vector<std::byte> damagedFrame(Script& script) {
  const rx60::Frame frame = encode(scriptedMessage(script));
  std::vector<std::byte> bytes(frame.bytes().begin(), frame.bytes().end());
  bytes.at(script.choice(bytes.size())) = std::byte{script.byte()};
  bytes.resize(bytes.size() - script.choice(bytes.size()) / 2);
  return bytes;
}

}  // namespace ringhook::fuzz
