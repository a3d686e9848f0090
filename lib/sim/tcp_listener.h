#pragma once

/// \file
/// One listening TCP port that serves one client at a time, without ever blocking: a second client
/// is turned away, what the client's socket does not take at once waits here.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ringhook {

/// Closes what it owns.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number = -1) : number_(number) {}
  ~FileDescriptor() { reset(); }
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  [[nodiscard]] int get() const { return number_; }
  [[nodiscard]] bool valid() const { return number_ >= 0; }
  void reset();

 private:
  int number_;
};

class TcpListener {
 public:
  /// \param address numeric IPv4 address of an interface of this host. \param port 0: a free one.
  /// Throws DeviceError naming address and port.
  TcpListener(const std::string& address, std::uint16_t port);

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] int listeningSocket() const { return listening_.get(); }
  [[nodiscard]] int clientSocket() const { return client_.get(); }  ///< -1 if there is none
  [[nodiscard]] bool connected() const { return client_.valid(); }

  enum class Arrival { kNone, kClient, kTurnedAway };
  /// Takes a waiting client, if any; `peer` is then its address and port.
  Arrival accept(std::string& peer);
  /// Adds what has arrived to `into`; false once the client has closed or the connection broke.
  bool read(std::vector<std::byte>& into);
  /// Sends what waits and then these bytes, as far as the socket takes them; false if the
  /// connection broke or the client has not read for long (64 KiB wait).
  bool write(std::span<const std::byte> bytes);
  void closeClient();

 private:
  FileDescriptor listening_;
  FileDescriptor client_;
  std::uint16_t port_ = 0;
  std::vector<std::byte> waiting_;  ///< to be sent
};

}  // namespace ringhook
