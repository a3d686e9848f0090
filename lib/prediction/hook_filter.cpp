#include "prediction/hook_filter.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "prediction/chi_square.h"
#include "prediction/hook_swing.h"

namespace ringhook {
namespace {

constexpr const char* kOutsideGate = "outside the gate";

void requirePositive(double value, const char* name) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw InputError(std::string("hook filter: ") + name + " must be positive, got " +
                     std::to_string(value));
  }
}

void requireNotNegative(double value, const char* name) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw InputError(std::string("hook filter: ") + name + " must not be negative, got " +
                     std::to_string(value));
  }
}

void checkOptions(const HookFilterOptions& o) {
  const std::pair<double, const char*> positive[] = {
      {o.pendulum_length_m, "pendulum_length_m"},
      {o.mass_kg, "mass_kg"},
      {o.gravity, "gravity"},
      {o.map_step_s, "map_step_s"},
      {o.speed_sigma, "speed_sigma"},
      {o.belt_acceleration_sigma, "belt_acceleration_sigma"},
      {o.hook_acceleration_sigma, "hook_acceleration_sigma"},
      {o.swing_sigma, "swing_sigma"},
      {o.rest_sigma, "rest_sigma"},
      {o.viscous_sigma, "viscous_sigma"},
      {o.dry_sigma, "dry_sigma"},
      {o.belt_change, "belt_change"},
      {o.next_length_sigma, "next_length_sigma"},
      {o.ready_sigma_m, "ready_sigma_m"},
      {o.neighbour_distance_m, "neighbour_distance_m"},
      {o.lost_after, "lost_after"},
      {o.max_horizon_s, "max_horizon_s"},
      {o.gate_probability, "gate_probability"},
      {1.0 - o.gate_probability, "1 - gate_probability"}};
  const std::pair<double, const char*> not_negative[] = {
      {o.length_sigma_m, "length_sigma_m"},
      {o.damping_kg_per_s, "damping_kg_per_s"},
      {o.position_floor_m, "position_floor_m"},
      {o.rotation_floor_rad, "rotation_floor_rad"},
      {o.pivot_jerk_density, "pivot_jerk_density"},
      {o.swing_density, "swing_density"},
      {o.rest_density, "rest_density"},
      {o.yaw_density, "yaw_density"},
      {o.hook_jerk_density, "hook_jerk_density"},
      {o.hook_turn_density, "hook_turn_density"},
      {o.warm_up_s, "warm_up_s"}};
  for (const auto& [value, name] : positive) {
    requirePositive(value, name);
  }
  for (const auto& [value, name] : not_negative) {
    requireNotNegative(value, name);
  }
}

}  // namespace

Outcome<HookEstimate> predictHook(const HookFilterState& state, Time time) {
  const double dt = time - state.time;
  if (!(std::abs(dt) <= state.options.max_horizon_s)) {
    return Refusal{"beyond the prediction horizon"};
  }
  if (state.swing) {
    return swingEstimate(predictSwing(*state.swing, time), time, state.options);
  }
  const HookBelief ahead = advanceHookBelief(state.belief, dt, state.options);
  return composeHookEstimate(ahead, time, state.options);
}

HookFilter::HookFilter(const HookFilterOptions& options) : options_(options) {
  checkOptions(options);
  gate_ = chiSquareQuantile(options.gate_probability, 6.0);
  if (options.model == HookMotionModel::kSphericalPendulum) {
    swing_.emplace(swingOptions(options));
  }
}

Outcome<FilterUpdate> HookFilter::update(const HookFix& fix) {
  if (lost_) {
    return Refusal{"lost"};
  }
  if (!fix.c1Mo.matrix().allFinite() || !fix.covariance.allFinite()) {
    return Refusal{"fix not finite"};
  }
  if (fix.covariance.llt().info() != Eigen::Success) {
    return Refusal{"fix covariance not positive definite"};
  }
  if (state_ && fix.time - state_->time > options_.max_horizon_s) {
    lost_ = true;
    return Refusal{"gap too long"};
  }
  if (swing_) {
    return swing(fix);
  }
  if (!state_) {
    return start(fix);
  }
  if (fix.time <= state_->time) {
    return Refusal{"late or duplicate time stamp"};
  }
  return step(fix);
}

Outcome<FilterUpdate> HookFilter::swing(const HookFix& fix) {
  if (isAnotherHook(fix)) {
    countRefusal();
    return Refusal{"another hook"};
  }
  if (!state_) {
    start_ = fix.time;
  }
  const Outcome<SwingUpdate> update = swing_->update(swingMeasurement(fix, options_));
  last_nis_ = swing_->lastNis();
  last_event_ = update ? update->event : SwingEvent::kNone;
  if (update) {
    ++taken_;
    refused_in_a_row_ = 0;
  } else if (update.reason() == kOutsideGate) {
    countRefusal();
  }
  if (const std::optional<SwingFilterState> now = swing_->state()) {
    state_ = HookFilterState{now->time, options_, {}, now};
    predicts_well_ = predicts_well_ || predictsWell();
    state_->ready = ready();
  }
  return update ? Outcome<FilterUpdate>(update->filter) : Refusal{update.reason()};
}

bool HookFilter::isAnotherHook(const HookFix& fix) const {
  if (!state_ || taken_ < options_.warm_up_fixes) {
    return false;
  }
  const Outcome<HookEstimate> expected = predictHook(*state_, fix.time);
  const Eigen::Vector3d seen = (options_.fMc1 * fix.c1Mo).translation();
  return expected && (seen - expected->fMo.translation()).norm() > options_.neighbour_distance_m;
}

void HookFilter::countRefusal() {
  ++refused_in_a_row_;
  lost_ = refused_in_a_row_ >= options_.lost_after;
}

bool HookFilter::predictsWell() const {
  constexpr double kHorizon = 0.3;  // [s]
  const Outcome<HookEstimate> ahead = predictHook(*state_, state_->time + kHorizon);
  if (!ahead) {
    return false;
  }
  const double variance = ahead->covariance.topLeftCorner<3, 3>().trace() / 3.0;
  return variance < options_.ready_sigma_m * options_.ready_sigma_m;
}

Outcome<FilterUpdate> HookFilter::start(const HookFix& fix) {
  state_ = HookFilterState{
      fix.time, options_, startHookBelief(hangingMeasurement(fix, options_), options_), {}, false};
  start_ = fix.time;
  taken_ = 1;
  state_->ready = ready();
  return FilterUpdate{fix.time, 0.0, 6};
}

Outcome<FilterUpdate> HookFilter::step(const HookFix& fix) {
  const HookBelief ahead = advanceHookBelief(state_->belief, fix.time - state_->time, options_);
  const auto correction = correctHookBelief(ahead, hangingMeasurement(fix, options_), options_);
  last_nis_ = correction.nis;
  state_->time = fix.time;
  if (!(correction.nis <= gate_)) {
    state_->belief = ahead;
    countRefusal();
    return Refusal{kOutsideGate};
  }
  state_->belief = correction.belief;
  refused_in_a_row_ = 0;
  ++taken_;
  state_->ready = ready();
  return FilterUpdate{fix.time, correction.nis, 6};
}

bool HookFilter::ready() const {
  return state_ && !lost_ && taken_ >= options_.warm_up_fixes &&
         state_->time - start_ >= options_.warm_up_s && (!swing_ || predicts_well_);
}

void HookFilter::restart() {
  if (swing_ && predicts_well_) {
    swing_.emplace(swingOptionsAfter(options_, state_->swing->belief));
  } else if (swing_) {
    swing_.emplace(swingOptions(options_));
  }
  predicts_well_ = false;
  last_event_ = SwingEvent::kNone;
  state_.reset();
  taken_ = 0;
  refused_in_a_row_ = 0;
  lost_ = false;
  last_nis_ = 0.0;
}

Outcome<HookEstimate> HookFilter::predict(Time time) const {
  if (lost_) {
    return Refusal{"lost"};
  }
  if (!state_) {
    return Refusal{"no fix yet"};
  }
  return predictHook(*state_, time);
}

std::optional<HookFilterState> HookFilter::state() const { return lost_ ? std::nullopt : state_; }

}  // namespace ringhook
