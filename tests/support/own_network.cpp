#include "own_network.h"

#include <arpa/inet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace ringhook::test {
namespace {

std::string failed(const std::string& what) { return what + ": " + std::strerror(errno); }

bool setAddress(int socket_number, const char* interface, const char* address) {
  ifreq request{};
  std::strncpy(request.ifr_name, interface, IFNAMSIZ - 1);
  auto* in = reinterpret_cast<sockaddr_in*>(&request.ifr_addr);
  in->sin_family = AF_INET;
  inet_pton(AF_INET, address, &in->sin_addr);
  return ioctl(socket_number, SIOCSIFADDR, &request) == 0;
}

bool bringUp(int socket_number, const char* interface) {
  ifreq request{};
  std::strncpy(request.ifr_name, interface, IFNAMSIZ - 1);
  request.ifr_flags = IFF_UP | IFF_RUNNING;
  return ioctl(socket_number, SIOCSIFFLAGS, &request) == 0;
}

std::string enter() {
  // Root first without a user namespace: in one it would lose the right to real-time priority.
  if (unshare(CLONE_NEWNET) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) {
    return failed("no network namespace can be made");
  }
  const int socket_number = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket_number < 0) {
    return failed("no socket can be made");
  }
  const bool up = setAddress(socket_number, "lo", "127.0.0.1") && bringUp(socket_number, "lo") &&
                  setAddress(socket_number, "lo:2", "127.0.0.2");
  const std::string why = up ? "" : failed("loopback cannot be set up");
  close(socket_number);
  return why;
}

}  // namespace

const std::string& ownNetwork() {
  static const std::string why = enter();
  return why;
}

}  // namespace ringhook::test
