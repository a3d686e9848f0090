#pragma once

/// \file
/// The hook's filter: fixes in, the hook's pose at any near instant out. Model and coordinates in
/// hook_model.h; here is the life of it: start with the first fix, gate on NIS, warm up, be lost
/// after too many refusals in a row, restart. With the model kSphericalPendulum (hook_swing.h) late
/// fixes are put where they belong, changes of the belt's speed and bumps are told, and restart()
/// keeps what the hook taught about its kind. The state is a value that may be copied to another
/// thread: predictHook() works on a copy and touches no filter.

#include <optional>

#include "core/hook_values.h"
#include "core/outcome.h"
#include "prediction/hook_model.h"
#include "prediction/swing_filter.h"

namespace ringhook {

/// All that a prediction needs, as a value.
struct HookFilterState {
  Time time;                              ///< of the last fix, taken or gated
  HookFilterOptions options;              ///< model and parameters that `belief` is about
  HookBelief belief;                      ///< at `time`
  std::optional<SwingFilterState> swing;  ///< instead of `belief` with kSphericalPendulum
  bool ready = false;                     ///< warmed up
};

/// Pose, twist and covariance at `time`, later or slightly earlier than the state's; refuses
/// "beyond the prediction horizon". Pure.
Outcome<HookEstimate> predictHook(const HookFilterState& state, Time time);

class HookFilter {
 public:
  /// Throws InputError naming the first option out of range.
  explicit HookFilter(const HookFilterOptions& options);

  /// Takes one fix. Refuses, and leaves the state as it was: "fix not finite", "fix covariance not
  /// positive definite", "late or duplicate time stamp" (kSphericalPendulum: "duplicate time stamp"
  /// and "too late"), "lost". Refuses "outside the gate" and leaves the state predicted to the
  /// fix's time; `lost_after` of these in a row make lost(), and so does a gap of more than
  /// max_horizon_s ("gap too long").
  /// A fix of a neighbour on the belt is refused as "another hook".
  Outcome<FilterUpdate> update(const HookFix& fix);

  /// True once enough fixes over enough time were taken and the hook is not lost; with
  /// kSphericalPendulum, once predictions 0.3 s ahead are good besides.
  [[nodiscard]] bool ready() const;
  /// True after too many refusals in a row or too long a gap, until restart().
  [[nodiscard]] bool lost() const { return lost_; }
  /// NIS of the last fix that came to the gate, taken or refused; 0 before. Chi-square of 6.
  [[nodiscard]] double lastNis() const { return last_nis_; }
  /// What the last fix revealed; kNone with the linear models.
  [[nodiscard]] SwingEvent lastEvent() const { return last_event_; }
  /// Forgets this hook: the next fix starts anew. kSphericalPendulum keeps what it learnt about
  /// length, friction and belt.
  void restart();

  /// predictHook on the current state; refuses "no fix yet" and "lost" besides.
  [[nodiscard]] Outcome<HookEstimate> predict(Time time) const;

  /// Snapshot for the control side; nothing before the first fix or when lost.
  [[nodiscard]] std::optional<HookFilterState> state() const;

 private:
  Outcome<FilterUpdate> start(const HookFix& fix);
  Outcome<FilterUpdate> step(const HookFix& fix);
  Outcome<FilterUpdate> swing(const HookFix& fix);
  [[nodiscard]] bool isAnotherHook(const HookFix& fix) const;
  void countRefusal();
  [[nodiscard]] bool predictsWell() const;

  HookFilterOptions options_;
  double gate_ = 0.0;  ///< on the NIS
  std::optional<HookFilterState> state_;
  std::optional<SwingFilter> swing_;  ///< with kSphericalPendulum
  Time start_;
  int taken_ = 0;  ///< fixes since the start
  int refused_in_a_row_ = 0;
  bool lost_ = false;
  double last_nis_ = 0.0;
  SwingEvent last_event_ = SwingEvent::kNone;
  bool predicts_well_ = false;  ///< since when it did; a later doubt does not stop a placing
};

}  // namespace ringhook
