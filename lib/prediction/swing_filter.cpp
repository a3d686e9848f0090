#include "prediction/swing_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "prediction/chi_square.h"

namespace ringhook {
namespace {

constexpr int kCalmEntries = 15;             // at least so many in a change of speed
constexpr int kCalmEvery = 5;                // so often its end is looked for
constexpr std::size_t kSettledEntries = 25;  // of the first fit that may be trusted
constexpr double kSettledLogLength = 1e-3;   // variance: 3 %
constexpr double kSettledProbability = 0.99999;

bool earlier(const SwingMeasurement& a, const SwingMeasurement& b) { return a.time < b.time; }

bool isGood(const SwingFit& fit) {
  return fit.chi_square < chiSquareQuantile(kSettledProbability, fit.residuals);
}

}  // namespace

SwingFilter::SwingFilter(const SwingFilterOptions& options) : options_(options) {}

Outcome<SwingUpdate> SwingFilter::update(const SwingMeasurement& measurement) {
  SwingUpdate update{{measurement.time, 0.0, swingSightSize(measurement.sight)}};
  if (entries_.empty()) {
    first_ = {measurement};
    entries_.push_back({measurement, options_.prior});
    if (!fitStart()) {
      entries_.clear();  // nothing is believed yet, and the next measurement is the first
      return Refusal{"fit did not converge"};
    }
    return update;
  }
  if (measurement.time <= entries_.back().measurement.time) {
    return insertLate(measurement);
  }
  const SwingEntry& last = entries_.back();
  entries_.push_back(swingStep(last.belief, last.measurement.time, measurement, mode_, options_));
  update.filter.nis = last_nis_ = entries_.back().nis;
  const bool taken = entries_.back().taken;
  if (!first_.empty()) {
    first_.push_back(measurement);
  }
  fitStart();
  update.event = lookForCause();
  calmDown();
  trim();
  if (!taken && update.event == SwingEvent::kNone) {
    return Refusal{"outside the gate"};
  }
  return update;
}

/// Puts a measurement between those that were there already and runs the later ones again.
Outcome<SwingUpdate> SwingFilter::insertLate(const SwingMeasurement& measurement) {
  if (entries_.back().measurement.time - measurement.time > options_.late_s ||
      measurement.time <= entries_.front().measurement.time) {
    return Refusal{"too late"};
  }
  const auto at = std::find_if(entries_.begin(), entries_.end(), [&](const SwingEntry& entry) {
    return entry.measurement.time >= measurement.time;
  });
  if (at->measurement.time == measurement.time) {
    return Refusal{"duplicate time stamp"};
  }
  const SwingEntry before = *(at - 1);
  std::deque<SwingEntry> later(at, entries_.end());
  later.push_front({measurement, before.belief});
  const std::deque<SwingEntry> replayed =
      replaySwing(before.belief, before.measurement.time, later, mode_, options_);
  const SwingEntry inserted = replayed.front();
  entries_.erase(at, entries_.end());
  entries_.insert(entries_.end(), replayed.begin(), replayed.end());
  if (!first_.empty()) {
    first_.insert(std::upper_bound(first_.begin(), first_.end(), measurement, earlier),
                  measurement);
  }
  if (!inserted.taken) {
    return Refusal{"outside the gate"};
  }
  return SwingUpdate{{measurement.time, inserted.nis, swingSightSize(measurement.sight)},
                     SwingEvent::kNone};
}

/// The batch fit of all measurements so far, when it is due. True if a start is known.
bool SwingFilter::fitStart() {
  if (first_.empty()) {
    return true;
  }
  if (first_.size() >= next_fit_ || !entries_.back().taken) {
    fitAll();
  }
  if (first_.back().time - first_.front().time >= options_.batch_s) {
    first_.clear();
    settled_ = true;
  }
  return first_state_.has_value();
}

/// True if one start explains all measurements since; then the belief is what follows from it. A
/// start that was good before is not given up for a fit that is not: outliers, or an event.
bool SwingFilter::fitAll() {
  next_fit_ = std::max(first_.size() + 1, first_.size() * 3 / 2);
  std::optional<SwingFit> fit = bestFit();
  if (options_.doubted_prior && !(fit && isGood(*fit))) {
    options_.prior = *options_.doubted_prior;
    options_.doubted_prior.reset();
    fit = bestFit();
  }
  const bool good = fit && isGood(*fit);
  if (!fit || (settled_ && !good)) {
    return false;
  }
  first_state_ = fit->start.mean;
  entries_.back().belief = fit->end;
  settled_ = good && first_.size() >= kSettledEntries &&
             fit->end.covariance(kSwingLogLength, kSwingLogLength) < kSettledLogLength;
  return good;
}

/// From a new guess and from the last fit's state: the better of both.
std::optional<SwingFit> SwingFilter::bestFit() const {
  std::vector<SwingVector> guesses{
      guessSwing(first_, options_.prior, options_.law, options_.pivot_o)};
  if (first_state_ && !settled_) {
    guesses.push_back(*first_state_);
  }
  std::optional<SwingFit> best;
  for (const SwingVector& guess : guesses) {
    const Outcome<SwingFit> fit =
        fitSwing(first_, options_.prior, guess, options_.law, options_.pivot_o);
    if (fit && (!best || fit->cost < best->cost)) {
      best = *fit;
    }
  }
  return best;
}

/// If the newest measurements surprise, finds the likeliest cause and believes in it.
SwingEvent SwingFilter::lookForCause() {
  if (!settled_ || mode_ == SwingMode::kChanging || !swingSurprise(entries_, options_)) {
    return SwingEvent::kNone;
  }
  if (!first_.empty() && fitAll()) {
    return SwingEvent::kNone;  // the filter had seen the law about a wrong state
  }
  SwingExplanation explanation = explainSwing(entries_, options_);
  if (explanation.event == SwingEvent::kNone) {
    return SwingEvent::kNone;
  }
  entries_ = std::move(explanation.entries);
  first_.clear();  // what came before no longer has the same start
  if (explanation.event == SwingEvent::kSpeedChange) {
    mode_ = SwingMode::kChanging;
    since_change_ = 0;
  }
  return explanation.event;
}

/// Ends a change of speed once the newest measurements are explained without one.
void SwingFilter::calmDown() {
  if (mode_ == SwingMode::kSteady || ++since_change_ < kCalmEntries ||
      since_change_ % kCalmEvery != 0) {
    return;
  }
  if (auto calmed = calmedSwing(entries_, options_)) {
    entries_ = std::move(*calmed);
    mode_ = SwingMode::kSteady;
  }
}

void SwingFilter::trim() {
  const Time newest = entries_.back().measurement.time;
  while (entries_.size() > 2 && newest - entries_[1].measurement.time > options_.late_s) {
    entries_.pop_front();
  }
}

void SwingFilter::setSteady(const SwingNoise& noise, double memory_s) {
  options_.steady = noise;
  options_.law.memory_s = memory_s;
}

std::optional<SwingFilterState> SwingFilter::state() const {
  if (entries_.empty()) {
    return std::nullopt;
  }
  return SwingFilterState{entries_.back().measurement.time, entries_.back().belief, options_.law,
                          swingNoise(options_, mode_)};
}

SwingBelief predictSwing(const SwingFilterState& state, Time time) {
  return walkSwingBelief(state.belief, time - state.time, state.law, state.noise);
}

}  // namespace ringhook
