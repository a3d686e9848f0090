#include "robot/rx60/frame_reader.h"

#include <algorithm>
#include <cassert>

namespace ringhook::rx60 {

std::span<std::byte> FrameReader::room() {
  if (begin_ > 0) {
    std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(begin_),
              bytes_.begin() + static_cast<std::ptrdiff_t>(end_), bytes_.begin());
    end_ -= begin_;
    begin_ = 0;
  }
  return std::span(bytes_).subspan(end_);
}

void FrameReader::commit(std::size_t count) {
  assert(count <= bytes_.size() - end_);
  end_ += count;
}

Outcome<std::optional<Message>> FrameReader::next() {
  const std::span<const std::byte> waiting(bytes_.data() + begin_, end_ - begin_);
  if (waiting.size() < kLengthBytes + kHeaderBytes) {
    return std::optional<Message>();
  }
  const Outcome<std::size_t> size = frameSize(waiting);
  if (!size) {
    return Refusal{size.reason()};
  }
  if (waiting.size() < *size) {
    return std::optional<Message>();
  }
  Outcome<Message> message = decode(waiting.first(*size));
  if (!message) {
    return Refusal{message.reason()};
  }
  begin_ += *size;
  return std::optional<Message>(*message);
}

void FrameReader::clear() { begin_ = end_ = 0; }

}  // namespace ringhook::rx60
