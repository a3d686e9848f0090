#include "wake_ups.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "bench_arm.h"
#include "machine_watch.h"
#include "robot/rx60/tcp_port.h"
#include "sim/rx60_controller.h"
#include "sim/tcp_listener.h"

namespace ringhook::bench {
namespace {

// Left to the scheduler, an echo may stay on the measuring thread's own processor, which is awake,
// while a client stays on another one, which sleeps: that compares processors, not programs.
constexpr unsigned kMeasuring = 0;
constexpr unsigned kAnswering = 1;

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
    stayOn(kAnswering);
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
    stayOn(kMeasuring);
    while (!allConnected()) {
    }
    auto next = Clock::now();
    while (static_cast<int>(ours_us_.size()) < cycles) {
      next += kTick;
      std::this_thread::sleep_until(next);
      cycle();
      // Half a tick later and not at once, so that neither finds caches and processor warmer.
      std::this_thread::sleep_until(next + kTick / 2);
      timeEcho();
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
    stayOn(kAnswering);
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
        echoed_ = states.front();
      }
    } else if (motion_.read(bytes_)) {
      controller_.receive(Rx60Socket::kMotion, bytes_);
    }
    bytes_.clear();
  }
  /// Once for every answer of the client.
  void timeEcho() {
    if (!echoed_) {
      return;
    }
    const auto sent = Clock::now();
    echo_.nearEnd().write(echoed_->bytes());
    if (takeNext(echo_.nearEnd(), bytes_)) {
      echo_us_.push_back(microseconds(Clock::now() - sent));
    }
    echoed_.reset();
    bytes_.clear();
  }

  TcpListener motion_{"127.0.0.1", 0};
  TcpListener state_{"127.0.0.1", 0};
  TcpListener io_{"127.0.0.1", 0};
  KinematicPlant plant_{startPosition()};
  Rx60Controller controller_{plant_};
  Echo echo_;
  std::optional<rx60::Frame> echoed_;
  Time now_;
  std::vector<std::byte> bytes_;
  std::vector<double> ours_us_;
  std::vector<double> echo_us_;
};

}  // namespace

void compareWakeUps(int cycles) {
  WakeUps wake_ups;
  wake_ups.measure(cycles);
  wake_ups.print();
}

}  // namespace ringhook::bench
