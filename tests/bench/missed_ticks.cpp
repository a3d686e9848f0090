#include "missed_ticks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "bench_arm.h"
#include "core/thread_priority.h"
#include "robot/rx60/tcp_port.h"
#include "sim/rx60_server.h"

namespace ringhook::bench {
namespace {

/// How much of the processors' time a host above this machine has given to others, of all there was
/// since the numbers before (Linux, /proc/stat: field 8 of the first line).
class StolenTime {
 public:
  StolenTime() : before_(read()) {}
  [[nodiscard]] double percent() const {
    const Ticks now = read();
    return now.all > before_.all ? 100.0 * (now.stolen - before_.stolen) / (now.all - before_.all)
                                 : 0.0;
  }

 private:
  struct Ticks {
    double stolen = 0.0;
    double all = 0.0;
  };
  static Ticks read() {
    std::ifstream stat("/proc/stat");
    std::string cpu;
    stat >> cpu;
    Ticks ticks;
    double value = 0.0;
    for (int field = 1; field <= 8 && stat >> value; ++field) {
      ticks.all += value;
      ticks.stolen = field == 8 ? value : 0.0;
    }
    return ticks;
  }
  Ticks before_;
};

/// A thread of the link's own rank that does nothing but wake every tick: what no client on this
/// machine can be better than.
class Metronome {
 public:
  Metronome() : thread_([this] { run(); }) {}
  ~Metronome() { finish(); }
  Metronome(const Metronome&) = delete;
  Metronome& operator=(const Metronome&) = delete;

  void finish() {
    end_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  /// Once finished.
  void print() const {
    std::printf(
        "%-28s %8lld wake-ups every 4 ms,  %6lld late by more than 4 ms, the latest by %.2f ms\n",
        "the machine itself", static_cast<long long>(wake_ups_), static_cast<long long>(late_),
        1e3 * worst_s_);
  }

 private:
  void run() {
    const RaisedPriority raised(kLinkRank);
    for (auto next = Clock::now() + kTick; !end_; next += kTick) {
      std::this_thread::sleep_until(next);
      const Clock::duration late = Clock::now() - next;
      ++wake_ups_;
      late_ += late > kTick ? 1 : 0;
      worst_s_ = std::max(worst_s_, std::chrono::duration<double>(late).count());
      next = late > kTick ? Clock::now() : next;
    }
  }

  std::atomic<bool> end_ = false;
  std::int64_t wake_ups_ = 0;
  std::int64_t late_ = 0;
  double worst_s_ = 0.0;
  std::thread thread_;
};

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

}  // namespace

void compareMissedTicks(double seconds) {
  const StolenTime stolen;
  Metronome metronome;
  Served ours;
  Served free_running;
  std::thread one([&] { serveOurs(ours, seconds); });
  std::thread two([&] { serveFreeRunning(free_running, seconds); });
  one.join();
  two.join();
  metronome.finish();
  ours.finish();
  free_running.finish();
  ours.print("our client");
  free_running.print("free-running 50 Hz client");
  metronome.print();
  std::printf("processor time that the host above this machine took away meanwhile: %.1f %%\n",
              stolen.percent());
}

}  // namespace ringhook::bench
