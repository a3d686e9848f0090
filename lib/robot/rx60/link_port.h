#pragma once

/// \file
/// Where the link's bytes and its time come from: three TCP connections and the host's steady
/// clock (tcp_port.h), or a controller simulated in the same process in virtual time
/// (sim/controller_port.h). The only part of the link that may look at a clock.

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "core/time.h"

namespace ringhook::rx60 {

/// The connections of the link, each a TCP port of the controller. State is read first: it tells
/// why a motion is refused.
enum class Channel { kState, kMotion, kIo };
inline constexpr std::array<Channel, 3> kChannels = {Channel::kState, Channel::kMotion,
                                                     Channel::kIo};
const char* nameOf(Channel channel);

class LinkPort {
 public:
  LinkPort() = default;
  LinkPort(const LinkPort&) = delete;
  LinkPort& operator=(const LinkPort&) = delete;
  virtual ~LinkPort() = default;

  [[nodiscard]] virtual Time now() const = 0;

  /// Opens all three connections, afresh if some were open. Throws DeviceError that names the
  /// address and what went wrong.
  virtual void open() = 0;
  /// Closes all three; nothing if they are closed.
  virtual void close() noexcept = 0;

  /// Takes what has arrived, at most into.size() bytes; 0 if nothing has. Nothing (nullopt) once
  /// the other end has closed or the connection broke.
  virtual std::optional<std::size_t> read(Channel channel, std::span<std::byte> into) = 0;

  /// Sends one frame whole. False if the connection broke or takes no more.
  virtual bool write(Channel channel, std::span<const std::byte> frame) = 0;

  /// Returns as soon as something has arrived or a connection has closed, at the latest at
  /// `deadline`.
  virtual void wait(Time deadline) = 0;
};

}  // namespace ringhook::rx60
