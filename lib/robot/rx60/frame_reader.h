#pragma once

/// \file
/// Whole messages out of a byte stream that may be cut anywhere. Bytes wait in a buffer of fixed
/// size; nothing is allocated. A length is believed only after type and size agree, so no input can
/// make the reader wait for more than one frame.

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "core/outcome.h"
#include "robot/rx60/messages.h"

namespace ringhook::rx60 {

class FrameReader {
 public:
  /// Room for the next bytes, never empty as long as next() is called until it has no more; write
  /// into its front, then commit() how many.
  [[nodiscard]] std::span<std::byte> room();
  /// Precondition: count <= room().size().
  void commit(std::size_t count);

  /// The next whole message; nothing while its bytes have not all arrived. Refused with words that
  /// say what came when the stream cannot be understood: from there on its framing is lost.
  [[nodiscard]] Outcome<std::optional<Message>> next();

  /// Forgets every byte, as for a new connection.
  void clear();

 private:
  std::array<std::byte, 4096> bytes_{};
  std::size_t begin_ = 0;  ///< first byte not yet given out
  std::size_t end_ = 0;    ///< behind the last byte that has arrived
};

}  // namespace ringhook::rx60
