#pragma once

/// \file
/// How the VAL3 server reads one of its sockets: prefix (4 bytes), header (12 bytes), body (as many
/// bytes as the type has; the announced length is not looked at), one message a pass. Hard on
/// whoever does not send frames whole:
/// - a type that it does not know throws away everything that has arrived, without a reply;
/// - if nothing is there where a header or a body would have to begin, it starts over: a frame that
///   is cut exactly behind its prefix or its header is lost, and its rest is taken for a frame. A
///   part of which a byte is there is waited for.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "robot/rx60/messages.h"

namespace ringhook {

class Rx60Receiver {
 public:
  /// \param velocity_addon whether VELOCITY_CFG and VELOCITY_CMD are known.
  explicit Rx60Receiver(bool velocity_addon) : velocity_addon_(velocity_addon) {}

  void push(std::span<const std::byte> bytes);
  /// One pass: the next message, if one is whole. What is neither a request nor a topic counts as a
  /// topic.
  std::optional<rx60::Message> next();
  void clear();

  [[nodiscard]] std::size_t waiting() const { return input_.size(); }  ///< bytes not yet read
  [[nodiscard]] int flushes() const { return flushes_; }  ///< times that input was thrown away

 private:
  enum class Part { kPrefix, kHeader, kBody };
  [[nodiscard]] std::size_t partBytes() const;
  /// The bytes of the current part move to frame_; false if they are not all there.
  bool takePart();

  bool velocity_addon_;
  std::vector<std::byte> input_;  ///< arrived, not yet read
  std::vector<std::byte> frame_;  ///< parts read of the message that is coming
  Part part_ = Part::kPrefix;
  int flushes_ = 0;
};

}  // namespace ringhook
