#include "sim/line_faults.h"

#include <algorithm>
#include <cmath>

namespace ringhook {

void FaultyLine::stall(Time from, double duration_s) {
  stall_from_ = from;
  stall_end_ = from + duration_s;
}

double FaultyLine::uniform() {
  // The library's distributions differ between implementations; this does not.
  return static_cast<double>(random_() >> 11U) * 0x1.0p-53;
}

/// When something due at `due` arrives, the stall considered.
Time FaultyLine::arrival(Time due) const {
  return due >= stall_from_ && due < stall_end_ ? stall_end_ : due;
}

void FaultyLine::send(std::span<const std::byte> bytes, Time due) {
  if (faults_.merge > 0.0) {
    due = Time::fromSeconds(std::ceil(due.seconds() / faults_.merge - 1e-9) * faults_.merge);
  }
  last_due_ = std::max(due, last_due_);
  pieces_.push_back({last_due_, {bytes.begin(), bytes.end()}});
}

void FaultyLine::push(std::span<const std::byte> message, Time now) {
  if (faults_.half_open || (faults_.loss > 0.0 && uniform() < faults_.loss)) {
    return;
  }
  const double jitter = faults_.jitter > 0.0 ? faults_.jitter * uniform() : 0.0;
  Time due = now + faults_.delay + jitter;
  if (!(faults_.split_gap > 0.0)) {
    send(message, due);
    return;
  }
  for (auto left = 2 + static_cast<std::size_t>(3.0 * uniform()); left > 1 && message.size() > 1;
       --left) {
    const auto most = static_cast<double>(message.size() - 1);
    const std::size_t size = 1 + static_cast<std::size_t>(most * uniform());
    send(message.first(size), due);
    message = message.subspan(size);
    due = due + faults_.split_gap;
  }
  send(message, due);
}

std::vector<std::byte> FaultyLine::pop(Time now) {
  std::vector<std::byte> arrived;
  while (!faults_.half_open && !pieces_.empty() && arrival(pieces_.front().due) <= now) {
    const std::vector<std::byte>& bytes = pieces_.front().bytes;
    arrived.insert(arrived.end(), bytes.begin(), bytes.end());
    pieces_.pop_front();
  }
  return arrived;
}

std::optional<Time> FaultyLine::nextDelivery() const {
  if (pieces_.empty() || faults_.half_open) {
    return std::nullopt;
  }
  return arrival(pieces_.front().due);
}

void FaultyLine::clear() {
  pieces_.clear();
  last_due_ = Time();
}

}  // namespace ringhook
