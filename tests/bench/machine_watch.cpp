#include "machine_watch.h"

#include <sched.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "core/thread_priority.h"

namespace ringhook::bench {
namespace {

constexpr auto kBeat = std::chrono::milliseconds(1);
constexpr int kFirst = kLinkRank + 10;  // before the link and the controller

}  // namespace

void stayOn(unsigned processor) {
  if (processor < std::thread::hardware_concurrency()) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(processor, &set);
    static_cast<void>(sched_setaffinity(0, sizeof set, &set));
  }
}

double StolenTime::percent() const {
  const Ticks now = read();
  return now.all > before_.all ? 100.0 * (now.stolen - before_.stolen) / (now.all - before_.all)
                               : 0.0;
}

StolenTime::Ticks StolenTime::read() {
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

MachineWatch::MachineWatch() {
  for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) {
    Watcher& watcher = watchers_.emplace_back();
    watcher.thread = std::thread([this, i, &watcher] { watch(i, watcher.spans); });
  }
}

void MachineWatch::finish() {
  end_ = true;
  for (Watcher& watcher : watchers_) {
    if (watcher.thread.joinable()) {
      watcher.thread.join();
    }
  }
}

void MachineWatch::watch(unsigned processor, std::vector<Span>& spans) const {
  stayOn(processor);
  const RaisedPriority raised(kFirst);
  for (auto due = Clock::now() + kBeat; !end_; due += kBeat) {
    std::this_thread::sleep_until(due);
    const auto woke = Clock::now();
    if (woke - due > kLate) {
      spans.push_back({due, woke});
    }
    due = std::max(due, woke - kBeat);  // beats that it slept through are not made up for
  }
}

bool MachineWatch::stoodStill(Clock::time_point from, Clock::time_point to) const {
  return std::ranges::any_of(watchers_, [&](const Watcher& watcher) {
    const auto span = std::ranges::lower_bound(watcher.spans, from, std::ranges::less{}, &Span::to);
    return span != watcher.spans.end() && span->from < to;
  });
}

std::size_t MachineWatch::standStills() const {
  std::size_t count = 0;
  for (const Watcher& watcher : watchers_) {
    count += watcher.spans.size();
  }
  return count;
}

double MachineWatch::longest_s() const {
  Clock::duration longest{0};
  for (const Watcher& watcher : watchers_) {
    for (const Span& span : watcher.spans) {
      longest = std::max(longest, span.to - span.from);
    }
  }
  return std::chrono::duration<double>(longest).count();
}

}  // namespace ringhook::bench
