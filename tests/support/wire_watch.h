#pragma once

/// \file
/// Looks at every velocity that a client puts on the wire, with code of its own: finite, within the
/// nominal speeds, the assumed accelerations and jerks from one command to the next.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "robot/rx60/link_port.h"
#include "sim/controller_port.h"

namespace ringhook::test {

/// The port to a simulated controller, watched. Throws std::runtime_error once virtual time passes
/// `patience`: somebody waits for what never comes.
class WireWatch final : public rx60::LinkPort {
 public:
  explicit WireWatch(std::unique_ptr<ControllerPort> port) : port_(std::move(port)) {}

  [[nodiscard]] Time now() const override { return port_->now(); }
  void open() override { port_->open(); }
  void close() noexcept override { port_->close(); }
  std::optional<std::size_t> read(rx60::Channel channel, std::span<std::byte> into) override {
    return port_->read(channel, into);
  }
  bool write(rx60::Channel channel, std::span<const std::byte> frame) override;
  void wait(Time deadline) override;

  ControllerPort& port() { return *port_; }
  [[nodiscard]] std::int64_t commands() const { return commands_; }
  [[nodiscard]] const std::vector<std::string>& violations() const { return violations_; }
  void setPatience(Time until) { patience_ = until; }

 private:
  void look(const JointVector& velocity);

  std::unique_ptr<ControllerPort> port_;
  Time patience_ = Time::fromSeconds(1e9);
  JointVector velocity_ = JointVector::Zero();      ///< the one before [rad/s]
  JointVector acceleration_ = JointVector::Zero();  ///< between the two before [rad/s^2]
  Time last_;                                       ///< of the one before
  std::int64_t commands_ = 0;
  std::vector<std::string> violations_;
};

}  // namespace ringhook::test
