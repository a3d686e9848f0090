#pragma once

/// \file
/// The simulated controller on real TCP sockets, as a client on a network meets it: four listening
/// ports, ticks every 4 ms of the host's steady clock on an absolute grid. A host that is too slow
/// for a tick leaves it out (and counts it) instead of catching up: two ticks at once would make a
/// faster controller than there is. The serving thread has real-time priority where that is
/// permitted (core/thread_priority.h), until it finds no more time to wait.

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/thread_priority.h"
#include "sim/rx60_controller.h"
#include "sim/rx60_lines.h"
#include "sim/tcp_listener.h"

namespace ringhook {

struct Rx60ServerOptions {
  std::string address = "127.0.0.1";  ///< numeric, of an interface of this host
  /// In the order of kRx60Sockets; 0 takes a free port, which port() then tells.
  std::array<std::uint16_t, kRx60Sockets.size()> ports = {11000, 11001, 11002, 11003};
  std::uint64_t seed = 1;  ///< of the lines' faults
};

class Rx60Server final : public Rx60Lines {
 public:
  /// Listens from now on; serves in run(). The controller must outlive the server. Throws
  /// DeviceError naming address and port if a port cannot be had.
  explicit Rx60Server(Rx60Controller& controller, const Rx60ServerOptions& options = {});

  [[nodiscard]] std::uint16_t port(Rx60Socket socket) const;

  /// Called before each of the controller's ticks, with the time since run() began.
  void onTick(std::function<void(Time)> action) { on_tick_ = std::move(action); }
  /// Called after each tick, once its messages are sent, with the time of the next one: for work
  /// that can be done ahead.
  void afterTick(std::function<void(Time)> action) { after_tick_ = std::move(action); }
  /// Called for each connection that comes, goes or is turned away.
  void onEvent(std::function<void(Time, const std::string&)> action) {
    on_event_ = std::move(action);
  }

  /// Waits until a client knocks at any port; it is let in by run(). False if `stop` was set first.
  [[nodiscard]] bool waitForClient(const std::atomic<bool>& stop) const;

  /// Serves on the caller's thread until `stop` is set or seconds [s] are over; then closes every
  /// connection. To be called once.
  void run(const std::atomic<bool>& stop, double seconds = std::numeric_limits<double>::infinity());

  /// Instant of the host's steady clock at which run() began.
  [[nodiscard]] Time startedAt() const { return started_; }
  [[nodiscard]] std::int64_t lateTicks() const { return late_ticks_; }  ///< left out
  /// Of the thread in run(): the one that it began with, or ordinary if it had to give it back.
  [[nodiscard]] ThreadPriority priority() const { return priority_; }

  // Faults of the lines; from onTick() or before run().
  [[nodiscard]] FaultyLine& toClient(Rx60Socket socket) override { return at(socket).to_client; }
  [[nodiscard]] FaultyLine& toController(Rx60Socket socket) override {
    return at(socket).to_controller;
  }
  void cut(Rx60Socket socket) override;

 private:
  struct Wire {
    TcpListener tcp;
    FaultyLine to_client;
    FaultyLine to_controller;
  };
  [[nodiscard]] Wire& at(Rx60Socket socket) { return wires_[static_cast<std::size_t>(socket)]; }
  void tell(const std::string& what);
  void sleepUntil(Time wake);
  void shareProcessor(RaisedPriority& raised);
  [[nodiscard]] Time nextEvent() const;
  void serve(Rx60Socket socket);
  void drop(Rx60Socket socket, const std::string& why);
  void runTick(Time clock);

  Rx60Controller& controller_;
  std::vector<Wire> wires_;
  std::function<void(Time)> on_tick_;
  std::function<void(Time)> after_tick_;
  std::function<void(Time, const std::string&)> on_event_;
  Time started_;           ///< host's steady clock
  Time now_;               ///< since run() began
  std::int64_t tick_ = 1;  ///< number of the next one, at tick_ * 4 ms
  std::int64_t late_ticks_ = 0;
  Time slept_;  ///< processor time of its thread when it last had time to wait
  ThreadPriority priority_ = ThreadPriority::kOrdinary;
};

}  // namespace ringhook
