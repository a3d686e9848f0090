// Is the link in time? In one run, over real TCP connections on loopback:
// 1. how many of the controller's ticks stay without a command while a 50 Hz vision target is
//    served, by our client (clocked by feedback) and by a free-running 50 Hz client, each with a
//    controller of its own, for the same 60 s;
// 2. how long it takes from the controller's feedback on the wire to the command on the wire,
//    beside a bare echo of as many bytes: the floor that system and scheduler leave.
//   rx60_link_bench --seconds 60 --cycles 15000

#include <poll.h>
#include <sys/socket.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "core/error.h"
#include "robot/rx60/rx60_arm.h"
#include "robot/rx60/tcp_port.h"
#include "sim/rx60_server.h"
#include "sim/tcp_listener.h"

namespace {

using namespace ringhook;
using Clock = std::chrono::steady_clock;

constexpr auto kTick = std::chrono::milliseconds(4);
constexpr auto kVisionPeriod = std::chrono::milliseconds(20);

JointVector startPosition() { return JointVector{{0.3, 0.4, 0.9, -0.2, 0.8, 0.1}}; }

JointVector targetAt(double t) {
  JointVector v;
  for (int i = 0; i < 6; ++i) {
    v[i] = 0.2 * std::sin((1.0 + 0.2 * i) * t + i) + 0.01;
  }
  return v;
}

/// Gives the arm its target; a fault (this machine stood still for too long) is told and cleared.
void command(Rx60Arm& arm, const JointVector& target) {
  try {
    arm.commandVelocity(target);
  } catch (const DeviceError&) {
    std::printf("fault: %s\n", arm.report().last_fault.c_str());
    arm.rearm();
  }
}

/// A served controller that notes how many ticks in a row stayed without a command.
class Served {
 public:
  Served() {
    Rx60ServerOptions options;
    options.ports = {0, 0, 0, 0};
    server_.emplace(controller_, options);
    server_->onTick([this](Time) { look(); });
    thread_ = std::thread([this] { server_->run(end_); });
  }
  ~Served() { finish(); }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  void finish() {
    end_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  /// From now on ticks are counted.
  void begin() { counting_ = true; }
  void pause() { counting_ = false; }
  [[nodiscard]] rx60::ControllerAddress address() const {
    rx60::ControllerAddress address;
    address.motion_port = server_->port(Rx60Socket::kMotion);
    address.state_port = server_->port(Rx60Socket::kState);
    address.io_port = server_->port(Rx60Socket::kIo);
    return address;
  }
  void print(const char* who) const {
    const double share =
        ticks_ > 0 ? 100.0 * static_cast<double>(missed_) / static_cast<double>(ticks_) : 0.0;
    std::printf("%-28s %8lld ticks in velocity mode, %6lld without a command (%.2f %%)", who,
                static_cast<long long>(ticks_), static_cast<long long>(missed_), share);
    std::printf("; runs of missed ticks:");
    for (const auto& [length, count] : runs_) {
      std::printf(" %lldx%d", static_cast<long long>(count), length);
    }
    std::printf("%s; ticks the server itself left out: %lld\n", runs_.empty() ? " none" : "",
                static_cast<long long>(server_->lateTicks()));
  }

 private:
  void look() {
    const Rx60Counts& counts = controller_.counts();
    if (counting_) {
      ticks_ += counts.velocity_ticks - last_.velocity_ticks;
      const auto missed = counts.missed_ticks - last_.missed_ticks;
      missed_ += missed;
      if (missed > 0) {
        ++run_;
      } else if (run_ > 0) {
        ++runs_[run_];
        run_ = 0;
      }
    }
    last_ = counts;
  }

  KinematicPlant plant_{startPosition()};
  Rx60Controller controller_{plant_};
  std::optional<Rx60Server> server_;
  std::atomic<bool> end_ = false;
  std::atomic<bool> counting_ = false;
  Rx60Counts last_;
  std::int64_t ticks_ = 0;
  std::int64_t missed_ = 0;
  int run_ = 0;
  std::map<int, std::int64_t> runs_;  ///< how often so many ticks in a row were missed
  std::thread thread_;
};

void serveOurs(Served& served, double seconds) {
  Rx60Arm arm(std::make_unique<rx60::TcpPort>(served.address()), {},
              Rx60Arm::Runs::kOnItsOwnThread);
  auto next = Clock::now();
  const auto begin = next + std::chrono::milliseconds(300);  // velocity mode is in force
  const auto end = begin + std::chrono::duration<double>(seconds);
  bool begun = false;
  while (Clock::now() < end) {
    if (!begun && Clock::now() >= begin) {
      begun = true;
      served.begin();
    }
    command(arm, targetAt(std::chrono::duration<double>(next - begin).count()));
    next += kVisionPeriod;
    std::this_thread::sleep_until(next);
  }
  served.pause();
  const rx60::LinkReport report = arm.report();
  std::printf(
      "our client: feedback period %.4f ms, jitter %.3f ms, longest gap %.2f ms, missed "
      "feedbacks %lld\n",
      1e3 * report.arrivals.period_s, 1e3 * report.arrivals.jitter_s,
      1e3 * report.arrivals.worst_gap_s, static_cast<long long>(report.arrivals.missed_cycles));
}

/// What a client does that sends on a timer of its own and reads whatever comes.
void serveFreeRunning(Served& served, double seconds) {
  rx60::TcpPort port(served.address());
  port.open();
  std::array<std::byte, 4096> sink{};
  const auto send = [&port](const rx60::Body& body) {
    port.write(rx60::Channel::kMotion,
               rx60::encode({rx60::CommType::kRequest, rx60::ReplyCode::kNone, body}).bytes());
  };
  const auto drain = [&] {
    for (const rx60::Channel channel : rx60::kChannels) {
      while (port.read(channel, sink).value_or(0) == sink.size()) {
      }
    }
  };
  const auto sleepTo = [&](Clock::time_point until) {
    while (Clock::now() < until) {
      port.wait(port.now() + std::chrono::duration<double>(until - Clock::now()).count());
      drain();
    }
  };
  sleepTo(Clock::now() + std::chrono::milliseconds(1300));  // the first status has been sent
  send(rx60::VelocityCfg{});
  auto next = Clock::now() + std::chrono::milliseconds(300);
  sleepTo(next);
  served.begin();
  const auto end = next + std::chrono::duration<double>(seconds);
  while (next < end) {
    rx60::VelocityCmd command;
    command.sequence = 1;
    const JointVector v = targetAt(std::chrono::duration<double>(next.time_since_epoch()).count());
    for (std::size_t i = 0; i < 6; ++i) {
      command.velocity[i] = static_cast<float>(v[static_cast<int>(i)]);
    }
    send(command);
    next += kVisionPeriod;
    sleepTo(next);
  }
  served.pause();
}

/// A listening socket whose other end is a thread that sends back what it gets.
class Echo {
 public:
  Echo() : listener_("127.0.0.1", 0), socket_(rx60::connectTo("127.0.0.1", listener_.port(), 2.0)) {
    std::string peer;
    while (listener_.accept(peer) != TcpListener::Arrival::kClient) {
    }
    thread_ = std::thread([this] { run(); });
  }
  ~Echo() {
    ::shutdown(socket_.get(), SHUT_RDWR);
    thread_.join();
  }
  Echo(const Echo&) = delete;
  Echo& operator=(const Echo&) = delete;
  TcpListener& nearEnd() { return listener_; }

 private:
  void run() {
    std::array<std::byte, 256> bytes{};
    pollfd waiting{socket_.get(), POLLIN, 0};
    while (::poll(&waiting, 1, -1) > 0) {
      const ssize_t count = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
      if (count <= 0) {
        return;
      }
      static_cast<void>(
          ::send(socket_.get(), bytes.data(), static_cast<std::size_t>(count), MSG_NOSIGNAL));
    }
  }
  TcpListener listener_;
  FileDescriptor socket_;
  std::thread thread_;
};

/// Waits for bytes on a listener's client and takes them; false after half a second.
bool takeNext(TcpListener& tcp, std::vector<std::byte>& into) {
  pollfd waiting{tcp.clientSocket(), POLLIN, 0};
  into.clear();
  return ::poll(&waiting, 1, 500) > 0 && tcp.read(into) && !into.empty();
}

double microseconds(Clock::duration d) {
  return std::chrono::duration<double, std::micro>(d).count();
}

double percentile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

void printLatency(const char* who, const std::vector<double>& us) {
  std::printf("%-28s p50 %8.1f us   p99 %8.1f us   p99.9 %8.1f us   (%zu cycles)\n", who,
              percentile(us, 0.5), percentile(us, 0.99), percentile(us, 0.999), us.size());
}

/// A controller on sockets of our own that measures each answer, and an echo beside it.
class WakeUps {
 public:
  void measure(int cycles) {
    std::atomic<bool> done = false;
    std::thread client([this, &done] { runClient(done); });
    while (!allConnected()) {
    }
    auto next = Clock::now();
    while (static_cast<int>(ours_us_.size()) < cycles) {
      next += kTick;
      std::this_thread::sleep_until(next);
      cycle();
    }
    done = true;
    for (int k = 0; k < 100; ++k) {  // the client stops the arm and goes
      next += kTick;
      std::this_thread::sleep_until(next);
      cycle();
    }
    state_.closeClient();
    client.join();
  }
  void print() const {
    printLatency("our client", ours_us_);
    printLatency("bare echo", echo_us_);
    std::printf("ratio of medians: %.2f\n", percentile(ours_us_, 0.5) / percentile(echo_us_, 0.5));
  }

 private:
  void runClient(const std::atomic<bool>& done) {
    rx60::ControllerAddress address;
    address.motion_port = motion_.port();
    address.state_port = state_.port();
    address.io_port = io_.port();
    rx60::LinkSettings settings;
    settings.stall_s = settings.reply_s = 1.0;  // the measuring thread may be held up
    Rx60Arm arm(std::make_unique<rx60::TcpPort>(address), settings, Rx60Arm::Runs::kOnItsOwnThread);
    for (double t = 0.0; !done; t += 0.02) {
      command(arm, targetAt(t));
      std::this_thread::sleep_for(kVisionPeriod);
    }
  }
  bool allConnected() {
    std::string peer;
    static_cast<void>(motion_.accept(peer));
    static_cast<void>(state_.accept(peer));
    static_cast<void>(io_.accept(peer));
    const bool all = motion_.connected() && state_.connected() && io_.connected();
    if (all) {
      controller_.connect(Rx60Socket::kMotion);
      controller_.connect(Rx60Socket::kState);
    }
    return all;
  }
  /// One tick of the controller; its feedback is timed if a command answers it.
  void cycle() {
    now_ = now_ + Rx60Controller::kTick;
    controller_.tick(now_);
    for (const rx60::Frame& frame : controller_.takeOutput(Rx60Socket::kMotion)) {
      motion_.write(frame.bytes());
    }
    const std::vector<rx60::Frame> states = controller_.takeOutput(Rx60Socket::kState);
    const bool serving = controller_.velocityMode() && !controller_.switchingMode();
    const auto sent = Clock::now();
    for (const rx60::Frame& frame : states) {
      state_.write(frame.bytes());
    }
    if (serving && takeNext(motion_, bytes_)) {
      const double us = microseconds(Clock::now() - sent);
      controller_.receive(Rx60Socket::kMotion, bytes_);
      if (bytes_.size() == 48 && states.size() == 1) {
        ours_us_.push_back(us);
        timeEcho(states.front());
      }
    } else if (motion_.read(bytes_)) {
      controller_.receive(Rx60Socket::kMotion, bytes_);
    }
    bytes_.clear();
  }
  void timeEcho(const rx60::Frame& frame) {
    const auto sent = Clock::now();
    echo_.nearEnd().write(frame.bytes());
    if (takeNext(echo_.nearEnd(), bytes_)) {
      echo_us_.push_back(microseconds(Clock::now() - sent));
    }
  }

  TcpListener motion_{"127.0.0.1", 0};
  TcpListener state_{"127.0.0.1", 0};
  TcpListener io_{"127.0.0.1", 0};
  KinematicPlant plant_{startPosition()};
  Rx60Controller controller_{plant_};
  Echo echo_;
  Time now_;
  std::vector<std::byte> bytes_;
  std::vector<double> ours_us_;
  std::vector<double> echo_us_;
};

}  // namespace

int main(int argc, char** argv) {
  double seconds = 60.0;
  int cycles = 15000;
  CLI::App app{"Measures the RX60 link on this machine"};
  app.add_option("--seconds", seconds, "Of the comparison")->check(CLI::PositiveNumber);
  app.add_option("--cycles", cycles, "Wake-ups to time")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);

  {
    Served ours;
    Served free_running;
    std::thread one([&] { serveOurs(ours, seconds); });
    std::thread two([&] { serveFreeRunning(free_running, seconds); });
    one.join();
    two.join();
    ours.finish();
    free_running.finish();
    ours.print("our client");
    free_running.print("free-running 50 Hz client");
  }
  WakeUps wake_ups;
  wake_ups.measure(cycles);
  wake_ups.print();
  return 0;
}
