#include "sim/tcp_listener.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr std::size_t kMostWaiting = 65536;  // [bytes]

[[noreturn]] void fail(const std::string& address, std::uint16_t port, const std::string& why) {
  throw DeviceError("Cannot listen on " + address + ", port " + std::to_string(port) + ": " + why +
                    ".");
}

bool later(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

/// The socket calls take addresses of every family as one type.
sockaddr* general(sockaddr_in& address) {
  return static_cast<sockaddr*>(static_cast<void*>(&address));
}

}  // namespace

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept
    : number_(std::exchange(other.number_, -1)) {}

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  if (this != &other) {
    reset();
    number_ = std::exchange(other.number_, -1);
  }
  return *this;
}

void FileDescriptor::reset() {
  if (number_ >= 0) {
    ::close(std::exchange(number_, -1));
  }
}

TcpListener::TcpListener(const std::string& address, std::uint16_t port)
    : listening_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  sockaddr_in local{};
  local.sin_family = AF_INET;
  local.sin_port = htons(port);
  if (::inet_pton(AF_INET, address.c_str(), &local.sin_addr) != 1) {
    fail(address, port, "a numeric address like 127.0.0.1 was expected");
  }
  const int on = 1;
  ::setsockopt(listening_.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  socklen_t size = sizeof local;
  if (!listening_.valid() || ::bind(listening_.get(), general(local), size) != 0 ||
      ::listen(listening_.get(), 4) != 0 ||
      ::getsockname(listening_.get(), general(local), &size) != 0) {
    fail(address, port, std::generic_category().message(errno));
  }
  port_ = ntohs(local.sin_port);
}

TcpListener::Arrival TcpListener::accept(std::string& peer) {
  sockaddr_in remote{};
  socklen_t size = sizeof remote;
  FileDescriptor made(
      ::accept4(listening_.get(), general(remote), &size, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!made.valid()) {
    return Arrival::kNone;
  }
  std::array<char, INET_ADDRSTRLEN> text{};
  ::inet_ntop(AF_INET, &remote.sin_addr, text.data(), text.size());
  peer = std::string(text.data()) + ":" + std::to_string(ntohs(remote.sin_port));
  if (client_.valid()) {
    return Arrival::kTurnedAway;
  }
  const int on = 1;
  ::setsockopt(made.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  client_ = std::move(made);
  waiting_.clear();
  return Arrival::kClient;
}

bool TcpListener::read(std::vector<std::byte>& into) {
  std::array<std::byte, 4096> room{};
  while (true) {
    const ssize_t count = ::recv(client_.get(), room.data(), room.size(), 0);
    if (count <= 0) {
      return count < 0 && later(errno);
    }
    into.insert(into.end(), room.begin(), room.begin() + count);
    if (static_cast<std::size_t>(count) < room.size()) {
      return true;
    }
  }
}

bool TcpListener::write(std::span<const std::byte> bytes) {
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  if (waiting_.empty()) {
    return true;
  }
  const ssize_t count = ::send(client_.get(), waiting_.data(), waiting_.size(), MSG_NOSIGNAL);
  if (count < 0 && !later(errno)) {
    return false;
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + (count > 0 ? count : 0));
  return waiting_.size() <= kMostWaiting;
}

void TcpListener::closeClient() {
  client_.reset();
  waiting_.clear();
}

}  // namespace ringhook
