#pragma once

/// \file
/// Wire bytes of the RX60's dialogue written by hand, so that the simulated controller is tested
/// without the project's own encoder; and a controller on a kinematic arm to send them to.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/rx60_controller.h"

namespace ringhook::test {

using Bytes = std::vector<std::byte>;

/// Little-endian values one after the other.
class ByteBuilder {
 public:
  ByteBuilder& u8(unsigned value) {
    bytes_.push_back(static_cast<std::byte>(value));
    return *this;
  }
  ByteBuilder& i32(std::int32_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    return u8(bits & 0xFF).u8(bits >> 8 & 0xFF).u8(bits >> 16 & 0xFF).u8(bits >> 24);
  }
  ByteBuilder& f32(double value) {
    return i32(std::bit_cast<std::int32_t>(static_cast<float>(value)));
  }
  ByteBuilder& floats(const std::vector<double>& values, std::size_t slots) {
    for (std::size_t i = 0; i < slots; ++i) {
      f32(i < values.size() ? values[i] : 0.0);
    }
    return *this;
  }
  [[nodiscard]] const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

inline constexpr std::int32_t kTopic = 1;
inline constexpr std::int32_t kRequest = 2;

/// Prefix, header and body.
Bytes frame(std::int32_t type, std::int32_t comm, const Bytes& body);
Bytes velocityCfg(std::int32_t comm = kRequest);
Bytes velocityCmd(std::int32_t sequence, const std::vector<double>& velocity,
                  std::int32_t comm = kTopic);
Bytes trajectoryPoint(std::int32_t sequence, const std::vector<double>& joints, double share = 1.0);
Bytes drivePower(bool on);
Bytes singleIo(std::int32_t module, std::int32_t pin, bool state);

/// One frame that the controller sent, taken apart by hand.
struct Sent {
  std::int32_t length = 0;
  std::int32_t type = 0;
  std::int32_t comm = 0;
  std::int32_t reply = 0;
  Bytes body;
  [[nodiscard]] std::int32_t i32(std::size_t at) const;  ///< at a byte of the body
  [[nodiscard]] double f32(std::size_t at) const;
  bool operator==(const Sent&) const = default;
};
std::vector<Sent> split(const Bytes& stream);

/// A controller on a kinematic arm, and its time.
class ControllerBench {
 public:
  explicit ControllerBench(const Rx60ControllerOptions& options = {})
      : controller(plant, options) {}

  void connectAll();
  void send(Rx60Socket socket, const Bytes& bytes) { controller.receive(socket, bytes); }
  /// `count` ticks.
  void run(int count = 1);
  /// What the controller sent since the last call.
  std::vector<Sent> sent(Rx60Socket socket);
  /// Connects, waits until motion is possible by the wire, forgets what was sent.
  void makeReady();
  /// The same, and in velocity mode.
  void makeVelocityReady();

  KinematicPlant plant;
  Rx60Controller controller;

 private:
  std::int64_t ticks_ = 0;
};

}  // namespace ringhook::test
