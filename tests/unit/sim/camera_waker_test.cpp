#include "sim/camera_waker.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cstdint>

#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

constexpr const char* kCamera = "127.77.5.3";
constexpr int kPatience_ms = 5000;

/// The control port of a camera.
FileDescriptor controlPort() {
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_port = htons(3956);
  inet_pton(AF_INET, kCamera, &own.sin_addr);
  FileDescriptor made(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (::bind(made.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) {
    throw DeviceError("the test's control port cannot be bound");
  }
  return made;
}

TEST(CameraWaker, AsksEachCameraForItsFirstRegisterAgainAndAgain) {
  const FileDescriptor camera = controlPort();
  const CameraWaker waker({"127.77.5.4", kCamera});  // nobody listens at the first
  for (int i = 0; i < 5; ++i) {
    pollfd asked{camera.get(), POLLIN, 0};
    ASSERT_EQ(::poll(&asked, 1, kPatience_ms), 1);
    std::array<std::uint8_t, 64> packet{};
    sockaddr_in who{};
    socklen_t size = sizeof who;
    ASSERT_EQ(::recvfrom(camera.get(), packet.data(), packet.size(), 0,
                         reinterpret_cast<sockaddr*>(&who), &size),
              12);
    // GigE Vision 2.0: key 0x42, acknowledge wanted, READREG 0x0080, one address, a request's
    // number other than 0, register 0.
    EXPECT_EQ(packet[0], 0x42);
    EXPECT_EQ(packet[1] & 0x01, 1);
    EXPECT_EQ(256 * packet[2] + packet[3], 0x0080);
    EXPECT_EQ(256 * packet[4] + packet[5], 4);
    EXPECT_NE(256 * packet[6] + packet[7], 0);
    EXPECT_EQ(packet[8] | packet[9] | packet[10] | packet[11], 0);
    ::sendto(camera.get(), packet.data(), 12, 0, reinterpret_cast<const sockaddr*>(&who), size);
  }
}

TEST(CameraWaker, NamesTheCameraThatHasNoAddress) {
  try {
    const CameraWaker waker({kCamera, "left"});
    FAIL() << "nothing was refused";
  } catch (const DeviceError& e) {
    EXPECT_THAT(e.what(), HasSubstr("a camera at left"));
  }
}

}  // namespace
}  // namespace ringhook
