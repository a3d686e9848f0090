#include "rx60_bytes.h"

#include <algorithm>
#include <stdexcept>

namespace ringhook::test {
namespace {

std::int32_t int32In(const Bytes& bytes, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    bits |= std::to_integer<std::uint32_t>(bytes.at(at + i)) << (8 * i);
  }
  return static_cast<std::int32_t>(bits);
}

}  // namespace

Bytes frame(std::int32_t type, std::int32_t comm, const Bytes& body) {
  Bytes bytes = ByteBuilder()
                    .i32(static_cast<std::int32_t>(12 + body.size()))
                    .i32(type)
                    .i32(comm)
                    .i32(0)
                    .bytes();
  bytes.insert(bytes.end(), body.begin(), body.end());
  return bytes;
}

Bytes velocityCfg(std::int32_t comm) {
  return frame(1640, comm,
               ByteBuilder().i32(1).floats({}, 12).f32(1.0).f32(1.0).f32(0.5).f32(1.0).bytes());
}

Bytes velocityCmd(std::int32_t sequence, const std::vector<double>& velocity, std::int32_t comm) {
  return frame(1641, comm, ByteBuilder().i32(sequence).floats(velocity, 6).i32(1).bytes());
}

Bytes trajectoryPoint(std::int32_t sequence, const std::vector<double>& joints, double share) {
  return frame(11, kRequest,
               ByteBuilder().i32(sequence).floats(joints, 10).f32(share).f32(0.0).bytes());
}

Bytes drivePower(bool on) { return frame(1610, kRequest, ByteBuilder().u8(on ? 1 : 0).bytes()); }

Bytes singleIo(std::int32_t module, std::int32_t pin, bool state) {
  return frame(1621, kRequest, ByteBuilder().i32(module).i32(pin).u8(state ? 1 : 0).bytes());
}

std::int32_t Sent::i32(std::size_t at) const { return int32In(body, at); }

double Sent::f32(std::size_t at) const {
  return static_cast<double>(std::bit_cast<float>(int32In(body, at)));
}

std::vector<Sent> split(const Bytes& stream) {
  std::vector<Sent> frames;
  for (std::size_t at = 0; at < stream.size();) {
    Sent sent{int32In(stream, at),
              int32In(stream, at + 4),
              int32In(stream, at + 8),
              int32In(stream, at + 12),
              {}};
    const std::size_t end = at + 4 + static_cast<std::size_t>(sent.length);
    if (sent.length < 12 || end > stream.size()) {
      throw std::runtime_error("the controller sent no whole frame");
    }
    sent.body.assign(stream.begin() + static_cast<std::ptrdiff_t>(at + 16),
                     stream.begin() + static_cast<std::ptrdiff_t>(end));
    frames.push_back(sent);
    at = end;
  }
  return frames;
}

void ControllerBench::connectAll() {
  for (const Rx60Socket socket : kRx60Sockets) {
    controller.connect(socket);
  }
}

void ControllerBench::run(int count) {
  for (int i = 0; i < count; ++i) {
    controller.tick(Time::fromNanoseconds(++ticks_ * 4'000'000));
  }
}

std::vector<Sent> ControllerBench::sent(Rx60Socket socket) {
  Bytes stream;
  for (const rx60::Frame& one : controller.takeOutput(socket)) {
    stream.insert(stream.end(), one.bytes().begin(), one.bytes().end());
  }
  return split(stream);
}

void ControllerBench::makeReady() {
  connectAll();
  run(275);  // 1.0 s, then 21 feedbacks until the first STATUS
  for (const Rx60Socket socket : kRx60Sockets) {
    sent(socket);
  }
}

void ControllerBench::makeVelocityReady() {
  makeReady();
  send(Rx60Socket::kMotion, velocityCfg());
  run(6);
  sent(Rx60Socket::kMotion);
}

}  // namespace ringhook::test
