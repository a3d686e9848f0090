#pragma once

/// \file
/// The hook's filter: fixes in, the hook's pose at any near instant out. Model and coordinates in
/// hook_model.h; here is the life of it: start with the first fix, gate on NIS, warm up, be lost
/// after too many refusals in a row, restart. The state is a value that may be copied to another
/// thread: predictHook() works on a copy and touches no filter.

#include <optional>

#include "core/hook_values.h"
#include "core/outcome.h"
#include "prediction/hook_model.h"

namespace ringhook {

/// All that a prediction needs, as a value.
struct HookFilterState {
  Time time;                  ///< of the last fix, taken or gated
  HookFilterOptions options;  ///< model and parameters that `belief` is about
  HookBelief belief;          ///< at `time`
  bool ready = false;         ///< warmed up
};

/// Pose, twist and covariance at `time`, later or slightly earlier than the state's; refuses
/// "beyond the prediction horizon". Pure.
Outcome<HookEstimate> predictHook(const HookFilterState& state, Time time);

class HookFilter {
 public:
  /// Throws InputError naming the first option out of range.
  explicit HookFilter(const HookFilterOptions& options);

  /// Takes one fix. Refuses, and leaves the state as it was: "fix not finite", "fix covariance not
  /// positive definite", "late or duplicate time stamp", "lost". Refuses "outside the gate" and
  /// leaves the state predicted to the fix's time; `lost_after` of these in a row make lost(), and
  /// so does a gap of more than max_horizon_s ("gap too long").
  Outcome<FilterUpdate> update(const HookFix& fix);

  /// True once enough fixes over enough time were taken and the hook is not lost.
  [[nodiscard]] bool ready() const;
  /// True after too many refusals in a row or too long a gap, until restart().
  [[nodiscard]] bool lost() const { return lost_; }
  /// NIS of the last fix that came to the gate, taken or refused; 0 before. Chi-square of 6.
  [[nodiscard]] double lastNis() const { return last_nis_; }
  /// Forgets everything: the next fix starts anew.
  void restart();

  /// predictHook on the current state; refuses "no fix yet" and "lost" besides.
  [[nodiscard]] Outcome<HookEstimate> predict(Time time) const;

  /// Snapshot for the control side; nothing before the first fix or when lost.
  [[nodiscard]] std::optional<HookFilterState> state() const;

 private:
  Outcome<FilterUpdate> start(const HookFix& fix);
  Outcome<FilterUpdate> step(const HookFix& fix);

  HookFilterOptions options_;
  double gate_ = 0.0;  ///< on the NIS
  std::optional<HookFilterState> state_;
  Time start_;
  int taken_ = 0;  ///< fixes since the start
  int refused_in_a_row_ = 0;
  bool lost_ = false;
  double last_nis_ = 0.0;
};

}  // namespace ringhook
