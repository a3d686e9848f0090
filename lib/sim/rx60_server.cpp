#include "sim/rx60_server.h"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <ctime>

namespace ringhook {
namespace {

constexpr std::int64_t kTickNs = 4'000'000;
constexpr double kLongestTurn = 0.2;  // at work without a pause, with real-time priority [s]
// Within a tick the streamer's task comes before the receivers', and so do its messages: a client
// reads why motion is not possible before it reads that a command was refused.
constexpr std::array<Rx60Socket, kRx60Sockets.size()> kSendingOrder = {
    Rx60Socket::kState, Rx60Socket::kMotion, Rx60Socket::kSystem, Rx60Socket::kIo};

Time tickTime(std::int64_t number) { return Time::fromNanoseconds(number * kTickNs); }

Time steadyNow() {
  const auto since_boot = std::chrono::steady_clock::now().time_since_epoch();
  return Time::fromNanoseconds(
      std::chrono::duration_cast<std::chrono::nanoseconds>(since_boot).count());
}

/// That this thread has had; time that the host took away does not count.
Time processorTime() {
  timespec used{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return Time::fromNanoseconds(used.tv_sec * 1'000'000'000 + used.tv_nsec);
}

}  // namespace

Rx60Server::Rx60Server(Rx60Controller& controller, const Rx60ServerOptions& options)
    : controller_(controller) {
  std::uint64_t seed = options.seed;
  for (const std::uint16_t port : options.ports) {
    wires_.push_back({TcpListener(options.address, port), FaultyLine(seed), FaultyLine(seed + 1)});
    seed += 2;
  }
}

std::uint16_t Rx60Server::port(Rx60Socket socket) const {
  return wires_[static_cast<std::size_t>(socket)].tcp.port();
}

void Rx60Server::tell(const std::string& what) {
  if (on_event_) {
    on_event_(now_, what);
  }
}

void Rx60Server::cut(Rx60Socket socket) {
  if (at(socket).tcp.connected()) {
    drop(socket, "cut by the controller");
  }
}

void Rx60Server::drop(Rx60Socket socket, const std::string& why) {
  Wire& wire = at(socket);
  wire.tcp.closeClient();
  wire.to_client.clear();
  wire.to_controller.clear();
  controller_.disconnect(socket);
  tell(std::string(nameOf(socket)) + ": " + why);
}

Time Rx60Server::nextEvent() const {
  Time next = tickTime(tick_);
  for (const Wire& wire : wires_) {
    next = std::min(next, wire.to_client.nextDelivery().value_or(next));
    next = std::min(next, wire.to_controller.nextDelivery().value_or(next));
  }
  return next;
}

/// Until then, or until a socket has something.
void Rx60Server::sleepUntil(Time wake) {
  std::array<pollfd, 2 * kRx60Sockets.size()> sockets{};
  for (std::size_t i = 0; i < wires_.size(); ++i) {
    sockets[2 * i] = {wires_[i].tcp.listeningSocket(), POLLIN, 0};
    sockets[2 * i + 1] = {wires_[i].tcp.clientSocket(), POLLIN, 0};  // -1 is passed over
  }
  const std::int64_t left_ns =
      std::clamp<std::int64_t>(wake.nanoseconds() - now_.nanoseconds(), 0, kTickNs);
  slept_ = left_ns > 0 ? processorTime() : slept_;
  const timespec timeout{0, static_cast<long>(left_ns)};
  ::ppoll(sockets.data(), sockets.size(), &timeout, nullptr);
}

/// What has come on one port, and what is due on its lines.
void Rx60Server::serve(Rx60Socket socket) {
  Wire& wire = at(socket);
  std::string peer;
  switch (wire.tcp.accept(peer)) {
    case TcpListener::Arrival::kNone:
      break;
    case TcpListener::Arrival::kClient:
      controller_.connect(socket);
      tell(std::string(nameOf(socket)) + ": client connected from " + peer);
      break;
    case TcpListener::Arrival::kTurnedAway:
      tell(std::string(nameOf(socket)) + ": second client turned away, " + peer);
      break;
  }
  if (!wire.tcp.connected()) {
    return;
  }
  std::vector<std::byte> arrived;
  const bool open = wire.tcp.read(arrived);
  if (!arrived.empty()) {
    wire.to_controller.push(arrived, now_);
  }
  controller_.receive(socket, wire.to_controller.pop(now_));
  if (!open) {
    drop(socket, "client gone");
  } else if (!wire.tcp.write(wire.to_client.pop(now_))) {
    drop(socket, "client gone or does not read");
  }
}

void Rx60Server::runTick(Time clock) {
  const std::int64_t due = clock.nanoseconds() / kTickNs;
  late_ticks_ += due - tick_;
  now_ = tickTime(due);
  tick_ = due + 1;
  if (on_tick_) {
    on_tick_(now_);
  }
  controller_.tick(now_);
  for (const Rx60Socket socket : kSendingOrder) {
    Wire& wire = at(socket);
    for (const rx60::Frame& frame : controller_.takeOutput(socket)) {
      wire.to_client.push(frame.bytes(), now_);
    }
    if (wire.tcp.connected() && !wire.tcp.write(wire.to_client.pop(now_))) {
      drop(socket, "client gone or does not read");
    }
  }
  if (after_tick_) {
    after_tick_(tickTime(tick_));
  }
}

bool Rx60Server::waitForClient(const std::atomic<bool>& stop) const {
  std::array<pollfd, kRx60Sockets.size()> sockets{};
  for (std::size_t i = 0; i < wires_.size(); ++i) {
    sockets[i] = {wires_[i].tcp.listeningSocket(), POLLIN, 0};
  }
  constexpr int kLook_ms = 100;
  while (!stop.load()) {
    if (::poll(sockets.data(), sockets.size(), kLook_ms) > 0) {
      return true;
    }
  }
  return false;
}

/// A host that cannot keep up shall not be kept from everything else as well.
void Rx60Server::shareProcessor(RaisedPriority& raised) {
  if (raised.reached() == ThreadPriority::kRealTime && processorTime() - slept_ > kLongestTurn) {
    raised.giveBack();
    priority_ = raised.reached();
    tell("no time left between ticks: real-time priority given back");
  }
}

void Rx60Server::run(const std::atomic<bool>& stop, double seconds) {
  RaisedPriority raised(kTickRank);
  priority_ = raised.reached();
  slept_ = processorTime();
  started_ = steadyNow();
  const auto clock = [this] { return Time::fromSeconds(steadyNow() - started_); };
  while (!stop.load() && clock().seconds() < seconds) {
    now_ = std::max(now_, clock());
    sleepUntil(nextEvent());
    now_ = std::max(now_, clock());
    for (const Rx60Socket socket : kRx60Sockets) {
      serve(socket);
    }
    if (now_ >= tickTime(tick_)) {
      runTick(now_);
      shareProcessor(raised);
    }
  }
  for (const Rx60Socket socket : kRx60Sockets) {
    if (at(socket).tcp.connected()) {
      drop(socket, "closed at the end");
    }
  }
}

}  // namespace ringhook
