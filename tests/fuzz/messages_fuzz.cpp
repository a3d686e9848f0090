// Any bytes: what decodes encodes to the same bytes, and a stream cut anywhere yields the messages
// that it holds, up to the first that cannot be understood.

#include <optional>
#include <vector>

#include "fuzz/script.h"
#include "robot/rx60/frame_reader.h"

namespace ringhook::fuzz {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t kPrefixBytes = rx60::kLengthBytes + rx60::kHeaderBytes;
constexpr std::size_t kModeAt = kPrefixBytes + 20;  // of STATUS

/// The frame as it would be sent: a pendant mode that is not known is -1.
Bytes canonical(std::span<const std::byte> frame, const rx60::Message& message) {
  Bytes bytes(frame.begin(), frame.end());
  const auto* status = std::get_if<rx60::RobotStatus>(&message.body);
  if (status != nullptr && status->mode == rx60::PendantMode::kUnknown) {
    std::fill_n(bytes.begin() + kModeAt, 4, std::byte{0xFF});
  }
  return bytes;
}

Bytes encoded(const rx60::Message& message) {
  const rx60::Frame frame = encode(message);
  return {frame.bytes().begin(), frame.bytes().end()};
}

/// The messages in a stream, cut by the lengths that their types have, and whether it was
/// understood to its end.
struct Stream {
  std::vector<Bytes> frames;
  bool understood = true;
};

Stream cutWhole(std::span<const std::byte> bytes) {
  Stream stream;
  while (bytes.size() >= kPrefixBytes) {
    const Outcome<std::size_t> size = rx60::frameSize(bytes);
    if (!size) {
      require(!size.reason().empty(), "a refusal has words");
      stream.understood = false;
      break;
    }
    require(*size > kPrefixBytes && *size <= rx60::kMaxFrameBytes, "a frame's size is known");
    if (*size > bytes.size()) {
      break;
    }
    const Outcome<rx60::Message> message = rx60::decode(bytes.first(*size));
    require(message.hasValue(), "a frame with a lawful prefix decodes");
    stream.frames.push_back(encoded(*message));
    require(stream.frames.back() == canonical(bytes.first(*size), *message),
            "what decodes encodes to the same bytes");
    bytes = bytes.subspan(*size);
  }
  return stream;
}

Stream readInPieces(std::span<const std::byte> bytes, std::size_t piece) {
  Stream stream;
  rx60::FrameReader reader;
  while (!bytes.empty()) {
    const std::span<std::byte> room = reader.room();
    require(!room.empty(), "there is room for the next bytes");
    const std::size_t count = std::min({room.size(), bytes.size(), piece});
    std::copy_n(bytes.begin(), count, room.begin());
    reader.commit(count);
    bytes = bytes.subspan(count);
    while (true) {
      const Outcome<std::optional<rx60::Message>> message = reader.next();
      if (!message) {
        require(!message.reason().empty(), "a refusal has words");
        stream.understood = false;
        return stream;
      }
      if (!*message) {
        break;
      }
      stream.frames.push_back(encoded(**message));
    }
  }
  return stream;
}

}  // namespace
}  // namespace ringhook::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  fuzz::Script script({data, size});
  const std::size_t piece = 1 + 7 * script.choice(256);
  const std::span<const std::byte> bytes = script.raw(size);
  const Outcome<rx60::Message> whole = rx60::decode(bytes);
  const fuzz::Stream expected = fuzz::cutWhole(bytes);
  fuzz::require(whole || !whole.reason().empty(), "a refusal has words");
  fuzz::require(!whole || expected.frames.size() == 1, "a whole frame is a stream of one");
  const fuzz::Stream read = fuzz::readInPieces(bytes, piece);
  fuzz::require(read.frames == expected.frames, "cuts change no message");
  fuzz::require(read.understood == expected.understood, "cuts do not change what is understood");
  return 0;
}
