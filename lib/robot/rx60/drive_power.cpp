#include "robot/rx60/drive_power.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "core/error.h"
#include "robot/rx60/frame_reader.h"

namespace ringhook::rx60 {
namespace {

constexpr int kPatienceMs = 2000;

/// The next message; throws DeviceError when none comes or it is not understood.
Message nextMessage(int socket) {
  FrameReader reader;
  while (true) {
    Outcome<std::optional<Message>> message = reader.next();
    if (!message) {
      throw DeviceError("The controller sent " + message.reason() + " on the system connection.");
    }
    if (*message) {
      return **message;
    }
    pollfd waiting{socket, POLLIN, 0};
    const std::span<std::byte> room = reader.room();
    const ssize_t count =
        ::poll(&waiting, 1, kPatienceMs) > 0 ? ::recv(socket, room.data(), room.size(), 0) : 0;
    if (count <= 0) {
      throw DeviceError("The controller does not reply on the system connection.");
    }
    reader.commit(static_cast<std::size_t>(count));
  }
}

void ask(int socket, bool on) {
  const Frame frame = encode(
      {CommType::kRequest, ReplyCode::kNone, SetDrivePower{static_cast<std::uint8_t>(on ? 1 : 0)}});
  if (::send(socket, frame.bytes().data(), frame.bytes().size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(frame.bytes().size())) {
    throw DeviceError("The controller takes nothing on the system connection.");
  }
  const Message reply = nextMessage(socket);
  if (reply.comm != CommType::kReply || !std::holds_alternative<SetDrivePower>(reply.body)) {
    throw DeviceError(std::string("The controller sent ") + nameOf(typeOf(reply.body)) +
                      " on the system connection, expected a reply to SET_DRIVE_POWER.");
  }
  if (reply.reply == ReplyCode::kFailure) {
    throw DeviceError("The controller refused to switch its drives.");
  }
}

}  // namespace

void setDrivePower(const ControllerAddress& address, bool on) {
  const int socket = connectTo(address.host, address.system_port, address.connect_timeout_s);
  try {
    ask(socket, on);
  } catch (...) {
    ::close(socket);
    throw;
  }
  ::close(socket);
}

}  // namespace ringhook::rx60
