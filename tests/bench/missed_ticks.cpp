#include "missed_ticks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "bench_arm.h"
#include "machine_watch.h"
#include "robot/rx60/tcp_port.h"
#include "sim/rx60_server.h"

namespace ringhook::bench {
namespace {

/// A served controller that notes which of its ticks found no command.
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
  /// Commands that the client has left out so far; to be told once a vision period, by one thread.
  void leftOut(std::int64_t count) {
    if (std::exchange(left_out_, count) != count) {
      left_out_at_.push_back(Clock::now());
    }
  }
  [[nodiscard]] rx60::ControllerAddress address() const {
    rx60::ControllerAddress address;
    address.motion_port = server_->port(Rx60Socket::kMotion);
    address.state_port = server_->port(Rx60Socket::kState);
    address.io_port = server_->port(Rx60Socket::kIo);
    return address;
  }
  /// Once finished.
  void print(const char* who, const MachineWatch& machine) const {
    const Tally all = tally(nullptr);
    const Tally awake = tally(&machine);
    std::printf("%-26s %6zu ticks in velocity mode, %6zu without a command (%.2f %%)", who,
                all.ticks, all.missed, share(all.missed, all.ticks));
    std::printf("; runs of missed ticks:");
    for (const auto& [length, count] : all.runs) {
      std::printf(" %dx%d", count, length);
    }
    std::printf("%s; ticks the server itself left out: %lld\n", all.runs.empty() ? " none" : "",
                static_cast<long long>(server_->lateTicks()));
    std::printf(
        "%-26s %6zu of these ticks,        %6zu without a command, %zu of them left out on "
        "purpose\n",
        "  while the machine ran", awake.ticks, awake.missed, awake.left_out);
  }

 private:
  struct Tick {
    Clock::time_point time;
    bool missed;  ///< it found no command
  };
  struct Tally {
    std::size_t ticks = 0;
    std::size_t missed = 0;
    std::size_t left_out = 0;  ///< of these, because the client sent none, see backlog_guard.h
    std::map<int, int> runs;   ///< how often so many ticks in a row were missed
  };

  void look() {
    const Rx60Counts& counts = controller_.counts();
    if (counting_ && counts.velocity_ticks != last_.velocity_ticks) {
      ticks_.push_back({Clock::now(), counts.missed_ticks != last_.missed_ticks});
    }
    last_ = counts;
  }
  static double share(std::size_t part, std::size_t all) {
    return all > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(all) : 0.0;
  }
  /// Whether the client was found to have left a command out soon after.
  [[nodiscard]] bool leftOutAbout(Clock::time_point tick) const {
    const auto found = std::ranges::lower_bound(left_out_at_, tick - kTick);
    return found != left_out_at_.end() && *found < tick + 2 * kVisionPeriod;
  }
  /// Of all ticks; with a machine, of those in whose last two periods no processor stood still:
  /// the feedback that a command answers is up to two periods older than the tick that takes it.
  [[nodiscard]] Tally tally(const MachineWatch* machine) const {
    Tally tally;
    int run = 0;
    const auto end_run = [&] {
      tally.runs[run] += run > 0 ? 1 : 0;
      run = 0;
    };
    for (const Tick& tick : ticks_) {
      if (machine != nullptr && machine->stoodStill(tick.time - 2 * kTick, tick.time)) {
        end_run();
        continue;
      }
      ++tally.ticks;
      tally.missed += tick.missed ? 1 : 0;
      tally.left_out += tick.missed && leftOutAbout(tick.time) ? 1 : 0;
      run += tick.missed ? 1 : 0;
      if (!tick.missed) {
        end_run();
      }
    }
    end_run();
    tally.runs.erase(0);
    return tally;
  }

  KinematicPlant plant_{startPosition()};
  Rx60Controller controller_{plant_};
  std::optional<Rx60Server> server_;
  std::atomic<bool> end_ = false;
  std::atomic<bool> counting_ = false;
  Rx60Counts last_;
  std::vector<Tick> ticks_;
  std::int64_t left_out_ = 0;
  std::vector<Clock::time_point> left_out_at_;
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
    served.leftOut(arm.report().left_out);
    next += kVisionPeriod;
    std::this_thread::sleep_until(next);
  }
  served.pause();
  const rx60::LinkReport report = arm.report();
  std::printf(
      "our client: feedback period %.4f ms, jitter %.3f ms, longest gap %.2f ms, missed "
      "feedbacks %lld, left out %lld commands\n",
      1e3 * report.arrivals.period_s, 1e3 * report.arrivals.jitter_s,
      1e3 * report.arrivals.worst_gap_s, static_cast<long long>(report.arrivals.missed_cycles),
      static_cast<long long>(report.left_out));
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
  MachineWatch machine;
  Served ours;
  Served free_running;
  std::thread one([&] { serveOurs(ours, seconds); });
  std::thread two([&] { serveFreeRunning(free_running, seconds); });
  one.join();
  two.join();
  ours.finish();
  free_running.finish();
  machine.finish();
  ours.print("our client", machine);
  free_running.print("free-running 50 Hz client", machine);
  std::printf(
      "the machine itself: a processor stood still for more than 1 ms %zu times, for %.2f ms at "
      "most; the host above took away %.1f %% of the processors' time\n",
      machine.standStills(), 1e3 * machine.longest_s(), stolen.percent());
}

}  // namespace ringhook::bench
