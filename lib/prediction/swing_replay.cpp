#include "prediction/swing_replay.h"

#include <algorithm>
#include <utility>

#include "prediction/chi_square.h"

namespace ringhook {
namespace {

constexpr int kSurpriseEntries = 5;
constexpr double kCap = 1.5;             // of the gate: what one innovation counts for at most
constexpr double kBetterBy = 20.0;       // in -2 ln p: odds of more than 20,000 to one
constexpr double kStandingSpeed = 2e-4;  // [m/s]; of a belt that stands
constexpr double kSurpriseProbability = 0.99999;

/// From the front entry's belief through the others in one mode; the front stays as it is.
std::deque<SwingEntry> again(const std::deque<SwingEntry>& entries, const SwingBelief& belief,
                             SwingMode mode, const SwingFilterOptions& options) {
  std::deque<SwingEntry> tail(entries.begin() + 1, entries.end());
  std::deque<SwingEntry> result =
      replaySwing(belief, entries.front().measurement.time, tail, mode, options);
  result.push_front(entries.front());
  return result;
}

SwingBelief struck(SwingBelief belief, double rate_sigma) {
  for (int axis = 0; axis < 2; ++axis) {
    belief.covariance(kSwingRate + axis, kSwingRate + axis) += rate_sigma * rate_sigma;
  }
  return belief;
}

/// Three states are measured to be zero with standard deviation `sigma`.
Correction<kSwingStates, 3> heldAtZero(const SwingBelief& belief, int place,
                                       const Eigen::Vector3d& sigma) {
  Eigen::Matrix<double, 3, kSwingStates> H = Eigen::Matrix<double, 3, kSwingStates>::Zero();
  H.middleCols<3>(place).setIdentity();
  const Eigen::Matrix3d R = sigma.cwiseAbs2().asDiagonal();
  return kalmanCorrect<kSwingStates, 3>(belief, Eigen::Vector3d::Zero(), H, R);
}

/// A bump is short, so its instant counts: just before the first of the refused.
std::deque<SwingEntry> afterBump(const std::deque<SwingEntry>& entries,
                                 const SwingFilterOptions& options) {
  const auto refused = std::find_if(entries.begin() + 1, entries.end(),
                                    [](const SwingEntry& entry) { return !entry.taken; });
  const auto before = (refused == entries.end() ? entries.begin() + 1 : refused) - 1;
  std::deque<SwingEntry> from(before, entries.end());
  std::deque<SwingEntry> result =
      again(from, struck(before->belief, options.bump_rate), SwingMode::kSteady, options);
  result.insert(result.begin(), entries.begin(), before);
  return result;
}

}  // namespace

SwingGate::SwingGate(double probability) {
  for (const int size : {1, 2, 3, 6}) {
    bound_[size] = chiSquareQuantile(probability, size);
    surprise_[size] = chiSquareQuantile(kSurpriseProbability, kSurpriseEntries * size);
  }
}

double SwingGate::bound(SwingSight sight) const { return bound_[swingSightSize(sight)]; }

double SwingGate::surprise(SwingSight sight) const { return surprise_[swingSightSize(sight)]; }

SwingNoise swingNoise(const SwingFilterOptions& options, SwingMode mode) {
  SwingNoise noise = options.steady;
  if (mode == SwingMode::kChanging) {
    noise.pivot_acceleration = options.changing_acceleration;
  }
  return noise;
}

SwingEntry swingStep(const SwingBelief& before, Time from, const SwingMeasurement& measurement,
                     SwingMode mode, const SwingFilterOptions& options) {
  SwingBelief ahead =
      walkSwingBelief(before, measurement.time - from, options.law, swingNoise(options, mode));
  if (!ahead.mean.allFinite() || !ahead.covariance.allFinite()) {
    ahead = before;  // a swing over the top, which only a wrong start can have
  }
  const SwingCorrection correction = correctSwing(ahead, measurement, options.pivot_o);
  const bool taken = correction.nis <= options.gate.bound(measurement.sight);
  return {measurement,    taken ? correction.belief : ahead, mode,
          correction.nis, correction.log_determinant,        taken};
}

std::deque<SwingEntry> replaySwing(const SwingBelief& before, Time from,
                                   const std::deque<SwingEntry>& entries, SwingMode mode,
                                   const SwingFilterOptions& options) {
  std::deque<SwingEntry> result;
  SwingBelief belief = before;
  Time time = from;
  for (const SwingEntry& entry : entries) {
    result.push_back(swingStep(belief, time, entry.measurement, mode, options));
    belief = result.back().belief;
    time = entry.measurement.time;
  }
  return result;
}

bool swingSurprise(const std::deque<SwingEntry>& entries, const SwingFilterOptions& options) {
  if (std::ssize(entries) < kSurpriseEntries) {
    return false;
  }
  double sum = 0.0;
  for (auto entry = entries.end() - kSurpriseEntries; entry != entries.end(); ++entry) {
    sum += std::min(entry->nis, kCap * options.gate.bound(entry->measurement.sight));
  }
  return sum > options.gate.surprise(entries.back().measurement.sight);
}

double swingMisfit(const std::deque<SwingEntry>& entries, const SwingFilterOptions& options) {
  double sum = 0.0;
  for (const SwingEntry& entry : entries) {
    const double gate = options.gate.bound(entry.measurement.sight);
    sum += std::min(entry.nis, kCap * gate) + entry.log_determinant;
  }
  return sum;
}

std::optional<std::deque<SwingEntry>> calmedSwing(const std::deque<SwingEntry>& entries,
                                                  const SwingFilterOptions& options) {
  const SwingBelief& before = entries.front().belief;
  const auto even = heldAtZero(before, kSwingAcceleration, options.steady.pivot_acceleration);
  const auto still =
      heldAtZero(even.belief, kSwingSpeed, Eigen::Vector3d::Constant(kStandingSpeed));
  std::optional<std::deque<SwingEntry>> best;
  double least = swingMisfit(entries, options);
  const std::pair<const SwingBelief*, double> held[] = {{&even.belief, even.nis},
                                                        {&still.belief, even.nis + still.nis}};
  for (const auto& [belief, nis] : held) {
    auto replayed = again(entries, *belief, SwingMode::kSteady, options);
    const double cost = swingMisfit(replayed, options) + nis;
    if (cost < least) {
      least = cost;
      best = std::move(replayed);
      best->front().belief = *belief;
    }
  }
  return best;
}

SwingExplanation explainSwing(const std::deque<SwingEntry>& entries,
                              const SwingFilterOptions& options) {
  SwingExplanation best{SwingEvent::kNone, entries};
  double least = swingMisfit(entries, options) - kBetterBy;
  const std::pair<SwingEvent, std::deque<SwingEntry>> others[] = {
      {SwingEvent::kSpeedChange,
       again(entries, entries.front().belief, SwingMode::kChanging, options)},
      {SwingEvent::kBump, afterBump(entries, options)}};
  for (const auto& [event, replayed] : others) {
    const double cost = swingMisfit(replayed, options);
    if (cost < least) {
      least = cost;
      best = {event, replayed};
    }
  }
  return best;
}

}  // namespace ringhook
