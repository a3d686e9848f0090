#pragma once

/// \file
/// A stretch of measurements run through the filter again: because one of them came late and has
/// to be put where it belongs, or because the newest do not fit and another course of events might
/// explain them. Explanations are compared by their likelihood: with innovations r_i of covariance
/// S_i, -2 ln p = sum of (r_i^T S_i^-1 r_i + ln det S_i) + constant (Bar-Shalom, Li, Kirubarajan,
/// 2001, section 11.6). An innovation beyond the gate counts as an outlier of the gate's own worth,
/// whatever its size, and moves nothing.

#include <array>
#include <deque>
#include <optional>
#include <span>

#include "prediction/swing_measurement.h"
#include "prediction/swing_start.h"
#include "prediction/swing_walk.h"

namespace ringhook {

/// The bounds of the innovations, once computed: chi-square quantiles are not for every frame.
class SwingGate {
 public:
  /// `probability` of a good measurement to pass, in (0, 1).
  explicit SwingGate(double probability = 0.9999);
  /// Largest NIS that passes.
  [[nodiscard]] double bound(SwingSight sight) const;
  /// Largest sum over five measurements that is not yet a surprise.
  [[nodiscard]] double surprise(SwingSight sight) const;

 private:
  std::array<double, 7> bound_{};     ///< by the measurement's size
  std::array<double, 7> surprise_{};  ///< likewise
};

/// What a swing filter is told.
struct SwingFilterOptions {
  SwingLaw law;
  Eigen::Vector3d pivot_o = Eigen::Vector3d::Zero();  ///< in o [m]; a point has its pivot at 0
  SwingPrior prior;                                   ///< before the first measurement
  std::optional<SwingPrior> doubted_prior;  ///< instead, once the measurements contradict `prior`
  SwingNoise steady;                        ///< process noise while the pivot travels evenly

  /// While the pivot changes its speed: Singer's standard deviation per axis in f [m/s^2].
  Eigen::Vector3d changing_acceleration{0.5, 0.5, 0.05};
  double bump_rate = 0.5;  ///< standard deviation of what a bump does to the swing rates [rad/s]

  SwingGate gate;        ///< on the NIS
  double batch_s = 3.0;  ///< so long the batch fit is repeated, at growing intervals
  double late_s = 0.4;   ///< how late a measurement may come, and how far back the
                         ///< cause of a surprise is looked for
};

enum class SwingMode {
  kSteady,   ///< the pivot travels evenly
  kChanging  ///< it starts, stops or is pushed
};

/// One measurement and what was believed after it.
struct SwingEntry {
  SwingMeasurement measurement;
  SwingBelief belief;  ///< at the measurement's time
  SwingMode mode = SwingMode::kSteady;
  double nis = 0.0;
  double log_determinant = 0.0;
  bool taken = true;  ///< false: beyond the gate
};

/// Process noise of a mode.
SwingNoise swingNoise(const SwingFilterOptions& options, SwingMode mode);

/// One filter step from `before` (at time `from`) over the measurement.
SwingEntry swingStep(const SwingBelief& before, Time from, const SwingMeasurement& measurement,
                     SwingMode mode, const SwingFilterOptions& options);

/// The entries again, in order, from `before`, in one mode.
std::deque<SwingEntry> replaySwing(const SwingBelief& before, Time from,
                                   const std::deque<SwingEntry>& entries, SwingMode mode,
                                   const SwingFilterOptions& options);

/// What the newest measurements say happened.
enum class SwingEvent {
  kNone,         ///< nothing out of the ordinary
  kSpeedChange,  ///< the pivot changes its speed: the belt starts or stops
  kBump          ///< something struck the hook: the swing rates jumped
};

struct SwingExplanation {
  SwingEvent event = SwingEvent::kNone;
  std::deque<SwingEntry> entries;  ///< under that explanation
};

/// True if the innovations of the newest entries are more than noise: their sum, each capped so
/// that a single outlier does not do it, is beyond what one stretch in a hundred thousand shows.
bool swingSurprise(const std::deque<SwingEntry>& entries, const SwingFilterOptions& options);

/// -2 ln p of the entries' measurements, up to a constant, outliers at the gate's own worth.
double swingMisfit(const std::deque<SwingEntry>& entries, const SwingFilterOptions& options);

/// The end of a change of speed: the entries anew with a pivot that travels evenly over all of
/// them, or stands still, if that explains them at least as well as the mode kChanging does; else
/// nothing. Precondition: at least two entries, all in mode kChanging.
std::optional<std::deque<SwingEntry>> calmedSwing(const std::deque<SwingEntry>& entries,
                                                  const SwingFilterOptions& options);

/// The likeliest course of events over `entries[1..]`, from the belief of `entries[0]`. Anything
/// but kNone has to be better by more than chance. Precondition: at least two entries.
SwingExplanation explainSwing(const std::deque<SwingEntry>& entries,
                              const SwingFilterOptions& options);

}  // namespace ringhook
