#include "sim/camera_waker.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <array>
#include <cstdint>

#include "core/error.h"
#include "core/thread_priority.h"

namespace ringhook {
namespace {

constexpr std::uint16_t kControlPort = 3956;
constexpr int kPeriod_ms = 4;
/// Key, acknowledge, READREG, 4 bytes follow, request 1, register 0 (GigE Vision 2.0, 14.3).
constexpr std::array<std::uint8_t, 12> kReadFirstRegister = {0x42, 0x01, 0x00, 0x80, 0x00, 0x04,
                                                             0x00, 0x01, 0x00, 0x00, 0x00, 0x00};

FileDescriptor controlSocket(const std::string& address) {
  sockaddr_in peer{};
  peer.sin_family = AF_INET;
  peer.sin_port = htons(kControlPort);
  FileDescriptor made(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!made.valid() || ::inet_pton(AF_INET, address.c_str(), &peer.sin_addr) != 1 ||
      ::connect(made.get(), reinterpret_cast<const sockaddr*>(&peer), sizeof peer) != 0) {
    throw DeviceError("no packet can be sent to a camera at " + address + ", port 3956");
  }
  return made;
}

}  // namespace

CameraWaker::CameraWaker(const std::vector<std::string>& addresses)
    : end_(::eventfd(0, EFD_CLOEXEC)) {
  if (!end_.valid()) {
    throw DeviceError("no event can be made to end the cameras' waker with");
  }
  for (const std::string& address : addresses) {
    sockets_.push_back(controlSocket(address));
  }
  thread_ = std::thread([this] { run(); });
}

CameraWaker::~CameraWaker() {
  static_cast<void>(::eventfd_write(end_.get(), 1));
  thread_.join();
}

void CameraWaker::run() {
  const RaisedPriority raised(kCameraRank);
  pollfd end{end_.get(), POLLIN, 0};
  std::array<std::uint8_t, 64> answer{};
  while (::poll(&end, 1, kPeriod_ms) == 0) {
    for (const FileDescriptor& socket : sockets_) {
      while (::recv(socket.get(), answer.data(), answer.size(), 0) > 0) {
      }
      static_cast<void>(
          ::send(socket.get(), kReadFirstRegister.data(), kReadFirstRegister.size(), MSG_NOSIGNAL));
    }
  }
}

}  // namespace ringhook
