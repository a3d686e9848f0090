#include "robot/rx60/tcp_port.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace ringhook::rx60 {
namespace {

constexpr short kReadable = POLLIN | POLLHUP | POLLERR;

std::string words(int error) { return std::generic_category().message(error); }

struct FreeAddresses {
  void operator()(addrinfo* list) const { freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

Addresses resolve(const std::string& host, std::uint16_t port) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int failed = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list);
  if (failed != 0) {
    throw DeviceError("The controller's host '" + host + "' is not known: " + gai_strerror(failed) +
                      ".");
  }
  return Addresses(list);
}

/// 0, or the error of connecting within the time.
int finishConnecting(int socket, double timeout_s) {
  pollfd waiting{socket, POLLOUT, 0};
  const int ready = ::poll(&waiting, 1, static_cast<int>(std::ceil(timeout_s * 1e3)));
  if (ready <= 0) {
    return ready == 0 ? ETIMEDOUT : errno;
  }
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

}  // namespace

int connectTo(const std::string& host, std::uint16_t port, double timeout_s) {
  int error = 0;
  const Addresses addresses = resolve(host, port);
  for (const addrinfo* a = addresses.get(); a != nullptr; a = a->ai_next) {
    const int made =
        ::socket(a->ai_family, a->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, a->ai_protocol);
    if (made < 0) {
      error = errno;
      continue;
    }
    error = ::connect(made, a->ai_addr, a->ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS) {
      error = finishConnecting(made, timeout_s);
    }
    const int on = 1;
    if (error == 0 && setsockopt(made, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on) == 0) {
      return made;
    }
    ::close(made);
  }
  throw DeviceError("No connection to the controller at " + host + ", port " +
                    std::to_string(port) + ": " + words(error) + ".");
}

TcpPort::TcpPort(ControllerAddress address) : address_(std::move(address)) {}

TcpPort::~TcpPort() { TcpPort::close(); }

Time TcpPort::now() const {
  const auto since_boot = std::chrono::steady_clock::now().time_since_epoch();
  return Time::fromNanoseconds(
      std::chrono::duration_cast<std::chrono::nanoseconds>(since_boot).count());
}

void TcpPort::open() {
  close();
  const std::array<std::uint16_t, kChannels.size()> ports = {
      address_.state_port, address_.motion_port, address_.io_port};
  for (std::size_t i = 0; i < sockets_.size(); ++i) {
    sockets_[i] = {connectTo(address_.host, ports[i], address_.connect_timeout_s), false};
  }
}

void TcpPort::close() noexcept {
  for (Socket& socket : sockets_) {
    if (socket.number >= 0) {
      ::close(socket.number);
    }
    socket = Socket();
  }
}

std::optional<std::size_t> TcpPort::read(Channel channel, std::span<std::byte> into) {
  Socket& socket = sockets_[static_cast<std::size_t>(channel)];
  if (socket.number < 0) {
    return std::nullopt;
  }
  if (!socket.readable) {
    return 0;  // wait() said so: saves a system call on the way to the answer
  }
  const ssize_t count = ::recv(socket.number, into.data(), into.size(), 0);
  if (count > 0) {
    const auto got = static_cast<std::size_t>(count);
    socket.readable = got == into.size();
    return got;
  }
  if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) {
    socket.readable = false;
    return 0;
  }
  return std::nullopt;
}

bool TcpPort::write(Channel channel, std::span<const std::byte> frame) {
  const int socket = sockets_[static_cast<std::size_t>(channel)].number;
  if (socket < 0) {
    return false;
  }
  // A frame that does not fit whole means that the peer has not read for seconds.
  ssize_t sent = 0;
  do {
    sent = ::send(socket, frame.data(), frame.size(), MSG_NOSIGNAL);
  } while (sent < 0 && errno == EINTR);
  return sent == static_cast<ssize_t>(frame.size());
}

void TcpPort::wait(Time deadline) {
  const double left_s = std::max(0.0, deadline - now());
  timespec timeout{};
  timeout.tv_sec = static_cast<time_t>(left_s);
  timeout.tv_nsec = static_cast<long>((left_s - std::floor(left_s)) * 1e9);
  std::array<pollfd, kChannels.size()> polled{};
  for (std::size_t i = 0; i < sockets_.size(); ++i) {
    polled[i] = {sockets_[i].number, POLLIN, 0};  // -1 is passed over
  }
  const bool any = ::ppoll(polled.data(), polled.size(), &timeout, nullptr) > 0;
  for (std::size_t i = 0; i < sockets_.size(); ++i) {
    sockets_[i].readable = any && (polled[i].revents & kReadable) != 0;
  }
}

}  // namespace ringhook::rx60
