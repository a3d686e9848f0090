#pragma once

/// \file
/// The link's connections as TCP sockets to a controller, and the host's steady clock.
/// Non-blocking, without Nagle's delay; one frame is one write.

#include <array>
#include <cstdint>
#include <string>

#include "robot/rx60/link_port.h"

namespace ringhook::rx60 {

/// Where a controller listens; the ports are those of the VAL3 server.
struct ControllerAddress {
  std::string host = "127.0.0.1";  ///< name or numeric address
  std::uint16_t motion_port = 11000;
  std::uint16_t system_port = 11001;
  std::uint16_t state_port = 11002;
  std::uint16_t io_port = 11003;
  double connect_timeout_s = 2.0;  ///< for each connection
};

/// A connected socket, or DeviceError that names host, port and what went wrong.
int connectTo(const std::string& host, std::uint16_t port, double timeout_s);

class TcpPort : public LinkPort {
 public:
  explicit TcpPort(ControllerAddress address);
  ~TcpPort() override;

  [[nodiscard]] Time now() const override;
  void open() override;
  void close() noexcept override;
  std::optional<std::size_t> read(Channel channel, std::span<std::byte> into) override;
  bool write(Channel channel, std::span<const std::byte> frame) override;
  void wait(Time deadline) override;

 private:
  ControllerAddress address_;
  struct Socket {
    int number = -1;
    bool readable = false;  ///< as far as the last wait() saw
  };
  std::array<Socket, kChannels.size()> sockets_;  ///< in the order of kChannels
};

}  // namespace ringhook::rx60
