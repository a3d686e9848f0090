#pragma once

/// \file
/// A simulated controller and its client in one process and in virtual time: the client's link
/// reads, writes and waits here as it would on TCP. Time moves in wait() alone, from one event to
/// the next: the controller's ticks on a grid of 4 ms, deliveries on the lines. Nothing reads a
/// clock, so a run is the same every time, as fast as the machine can.
///
/// A command written at the instant of a tick, in answer to the state that this tick sent, is
/// received in the next tick: a round trip of 4 ms, as with a client on a real network.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "robot/rx60/link_port.h"
#include "sim/rx60_controller.h"
#include "sim/rx60_lines.h"

namespace ringhook {

class ControllerPort final : public rx60::LinkPort, public Rx60Lines {
 public:
  /// Controller and plant must outlive the port. Its time, and the plant's, begin at `start`, a
  /// whole number of ticks; the first tick comes 4 ms later.
  explicit ControllerPort(Rx60Controller& controller, Rx60Plant& plant, Time start = Time(),
                          std::uint64_t seed = 1);

  [[nodiscard]] Time now() const override { return now_; }
  void open() override;
  void close() noexcept override;
  std::optional<std::size_t> read(rx60::Channel channel, std::span<std::byte> into) override;
  bool write(rx60::Channel channel, std::span<const std::byte> frame) override;
  /// A connection that the controller closed wakes the client until read() has told it.
  void wait(Time deadline) override;

  // Mishaps. Faults of a line: setFaults() and stall() of these.
  [[nodiscard]] FaultyLine& toClient(Rx60Socket socket) override { return at(socket).to_client; }
  [[nodiscard]] FaultyLine& toController(Rx60Socket socket) override {
    return at(socket).to_controller;
  }
  void cut(Rx60Socket socket) override;
  /// So many further calls of open() throw.
  void refuseOpening(int times) { openings_to_refuse_ = times; }
  /// Called at the beginning of every tick, before the controller's.
  void onTick(std::function<void(Time)> action) { on_tick_ = std::move(action); }

  [[nodiscard]] int openings() const { return openings_; }  ///< calls of open() that succeeded

 private:
  enum class Line { kClosed, kOpen, kCut, kCutAndTold };
  struct Wire {
    Line state = Line::kClosed;
    FaultyLine to_client;
    FaultyLine to_controller;
    std::vector<std::byte> arrived;  ///< at the client, not yet read
  };
  [[nodiscard]] Wire& at(Rx60Socket socket) { return wires_.at(static_cast<std::size_t>(socket)); }
  [[nodiscard]] bool wakes() const;
  [[nodiscard]] Time nextEvent() const;
  void deliver();
  void runTick();

  Rx60Controller& controller_;
  Rx60Plant& plant_;
  Time now_;
  Time next_tick_;
  std::array<Wire, kRx60Sockets.size()> wires_;
  std::function<void(Time)> on_tick_;
  int openings_ = 0;
  int openings_to_refuse_ = 0;
};

/// The controller's socket behind a channel of the link.
Rx60Socket socketOf(rx60::Channel channel);

}  // namespace ringhook
