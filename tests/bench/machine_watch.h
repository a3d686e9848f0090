#pragma once

/// \file
/// Was the machine there at all? On a shared host a processor is taken away for milliseconds, and
/// no program that runs on it can answer meanwhile. What a client misses at such a moment says
/// nothing of the client. So a thread on each processor, before all others there, does nothing but
/// wake once a millisecond: where it wakes late, the processor stood still.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <thread>
#include <vector>

namespace ringhook::bench {

/// The calling thread, and threads that it starts, run on this processor alone from now on; nothing
/// if the machine has no such processor.
void stayOn(unsigned processor);

/// How much of the processors' time a host above this machine has given to others, of all there was
/// since the construction (Linux, /proc/stat: field 8 of the first line).
class StolenTime {
 public:
  StolenTime() : before_(read()) {}
  [[nodiscard]] double percent() const;

 private:
  struct Ticks {
    double stolen = 0.0;
    double all = 0.0;
  };
  static Ticks read();
  Ticks before_;
};

/// Watches all processors from its construction to finish().
class MachineWatch {
 public:
  using Clock = std::chrono::steady_clock;
  /// A wake-up later than this is a stand-still, from when it was due to when it came.
  static constexpr auto kLate = std::chrono::milliseconds(1);

  MachineWatch();
  ~MachineWatch() { finish(); }
  MachineWatch(const MachineWatch&) = delete;
  MachineWatch& operator=(const MachineWatch&) = delete;

  void finish();

  // Once finished:
  /// Whether some processor stood still between the two times.
  [[nodiscard]] bool stoodStill(Clock::time_point from, Clock::time_point to) const;
  [[nodiscard]] std::size_t standStills() const;
  [[nodiscard]] double longest_s() const;

 private:
  struct Span {
    Clock::time_point from;
    Clock::time_point to;
  };
  struct Watcher {
    std::vector<Span> spans;  ///< in the order of time; written by its thread alone
    std::thread thread;
  };
  void watch(unsigned processor, std::vector<Span>& spans) const;

  std::atomic<bool> end_ = false;
  std::deque<Watcher> watchers_;  ///< one for each processor
};

}  // namespace ringhook::bench
