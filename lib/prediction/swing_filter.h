#pragma once

/// \file
/// The life of the swing filter: a batch fit at the start, repeated as data grow, then an extended
/// Kalman filter that goes on learning length and friction; measurements that come late are put
/// where they belong; a belt that changes its speed and a bump are told from outliers.
/// At the start the fit is made anew whenever the measurements are half as many again, so that all
/// of them see the law linearised about the best state and none about a first guess; between two
/// fits the filter carries on.

#include <deque>
#include <optional>
#include <vector>

#include "core/outcome.h"
#include "prediction/swing_replay.h"
#include "prediction/swing_start.h"

namespace ringhook {

/// All that a prediction needs, as a value.
struct SwingFilterState {
  Time time;  ///< of the newest measurement
  SwingBelief belief;
  SwingLaw law;
  SwingNoise noise;  ///< of the mode that the filter is in
};

/// What one measurement did.
struct SwingUpdate {
  FilterUpdate filter;                   ///< time, NIS and its degrees of freedom
  SwingEvent event = SwingEvent::kNone;  ///< what it revealed
};

class SwingFilter {
 public:
  explicit SwingFilter(const SwingFilterOptions& options);

  /// Refuses, and changes nothing: "duplicate time stamp", "too late" (older than late_s). Refuses
  /// "outside the gate": the belief is predicted to the measurement's time.
  Outcome<SwingUpdate> update(const SwingMeasurement& measurement);

  /// From the next measurement on: process noise of a pivot that travels evenly, and the memory of
  /// its acceleration [s].
  void setSteady(const SwingNoise& noise, double memory_s);

  /// Nothing before the first measurement.
  [[nodiscard]] std::optional<SwingFilterState> state() const;
  [[nodiscard]] SwingMode mode() const { return mode_; }
  /// NIS of the last measurement, taken or refused; 0 before.
  [[nodiscard]] double lastNis() const { return last_nis_; }

 private:
  Outcome<SwingUpdate> insertLate(const SwingMeasurement& measurement);
  bool fitStart();
  bool fitAll();
  [[nodiscard]] std::optional<SwingFit> bestFit() const;
  SwingEvent lookForCause();
  void calmDown();
  void trim();

  SwingFilterOptions options_;
  std::deque<SwingEntry> entries_;          ///< the newest late_s, oldest first
  std::vector<SwingMeasurement> first_;     ///< all since the start while the batch fit goes on
  std::size_t next_fit_ = 1;                ///< fit again when so many have come
  std::optional<SwingVector> first_state_;  ///< that the last fit found, at the first measurement
  bool settled_ = false;  ///< the fit is good enough to be surprised by what does not suit it
  SwingMode mode_ = SwingMode::kSteady;
  int since_change_ = 0;  ///< measurements since the pivot began to change its speed
  double last_nis_ = 0.0;
};

/// Belief at `time`, later or earlier than the state's.
SwingBelief predictSwing(const SwingFilterState& state, Time time);

}  // namespace ringhook
