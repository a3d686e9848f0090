#pragma once

/// \file
/// One direction of a TCP connection with what can go wrong on it, in virtual time: late,
/// jittering, lost, split, merged and stalled data, and the half-open connection that swallows
/// everything. As in TCP, the order of bytes is always kept. Deterministic from its seed.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "core/time.h"

namespace ringhook {

struct LineFaults {
  double delay = 0.0;      ///< of everything [s]
  double jitter = 0.0;     ///< on top, uniform from 0 to this for each message [s]
  double loss = 0.0;       ///< share of messages that the sender never sent, 0 to 1
  double split_gap = 0.0;  ///< if positive: in 2 to 4 pieces, this far apart [s]
  double merge = 0.0;      ///< if positive: arrives at whole multiples of this only, together [s]
  bool half_open = false;  ///< accepts everything, delivers nothing more, never closes
};

class FaultyLine {
 public:
  explicit FaultyLine(std::uint64_t seed = 1) : random_(seed) {}

  /// Of what is sent from now on.
  void setFaults(const LineFaults& faults) { faults_ = faults; }
  [[nodiscard]] const LineFaults& faults() const { return faults_; }
  /// Nothing arrives from `from` on for duration_s [s]; then all that was held back.
  void stall(Time from, double duration_s);

  /// A message is sent. Time must not go back from call to call.
  void push(std::span<const std::byte> message, Time now);
  /// What has arrived since the last call.
  std::vector<std::byte> pop(Time now);
  /// When pop() will next have something; nothing if nothing is under way.
  [[nodiscard]] std::optional<Time> nextDelivery() const;
  /// Forgets what is under way.
  void clear();

 private:
  struct Piece {
    Time due;
    std::vector<std::byte> bytes;
  };
  double uniform();  ///< 0 to 1
  [[nodiscard]] Time arrival(Time due) const;
  void send(std::span<const std::byte> bytes, Time due);

  LineFaults faults_;
  std::mt19937_64 random_;
  std::deque<Piece> pieces_;  ///< under way, in order
  Time last_due_;
  Time stall_from_;
  Time stall_end_;
};

}  // namespace ringhook
