#include "robot/limiter.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kBisections = 12;
constexpr double kAim = 0.98;  // of tool speed and singular speeds, so as not to graze them
constexpr double kBetweenEnds = 0.995;  // tool speed bound on the ends of a period, for all of it
constexpr double kSame = 1e-9;          // [rad/s]

bool positive(const JointVector& v) { return v.allFinite() && (v.array() > 0.0).all(); }
bool within(double value, double low, double high) { return value >= low && value <= high; }

void require(bool fulfilled, const char* what) {
  if (!fulfilled) {
    throw InputError(std::string("Limiter settings: expected ") + what + ".");
  }
}

void check(const LimiterSettings& s) {
  constexpr double kMost = 1e6;
  require(positive(s.limits.velocity) && positive(s.limits.acceleration) && positive(s.limits.jerk),
          "positive limits of speed, acceleration and jerk for each joint");
  require(within(s.position_margin_rad, 0.0, 1.0), "a position margin from 0 to 1 rad");
  require(s.limits.lower.allFinite() && s.limits.upper.allFinite() &&
              ((s.limits.upper - s.limits.lower).array() > 2.0 * s.position_margin_rad).all(),
          "lower position limits below the upper ones by more than both margins");
  require(within(s.velocity_fraction, 1e-6, 1.0), "a velocity fraction above 0 and up to 1");
  require(s.tool_e.allFinite(), "a finite tool point");
  require(within(s.tool_speed_automatic_m_s, 1e-6, kToolSpeedAutomatic) &&
              within(s.tool_speed_manual_m_s, 1e-6, kToolSpeedAutomatic),
          "tool speeds above 0 and up to 1.8 m/s");
  require(within(s.singular_below, 1e-12, kMost), "a positive manipulability threshold");
  require(within(s.least_share, 1e-6, 1.0), "a least share of speed above 0 and up to 1");
  require((s.box.lower.array() < s.box.upper.array()).all(), "a box with lower below upper sides");
  require(within(s.lag_periods, 0, 8), "a lag of 0 to 8 periods");
  require(within(s.jump_rad, 1e-6, kMost), "a positive jump");
  require(within(s.period_s, 1e-6, 1.0), "a period above 0 and up to 1 s");
}

/// Shortens the wanted vector into joint speeds and tool speed at this place.
JointVector shorten(const JointVector& wanted, const StopBounds& bounds, const JointVector& q,
                    LimitedVelocity& out) {
  const double ratio = bounds.speedRatio(wanted);
  out.speed = ratio > 1.0;
  JointVector target = out.speed ? JointVector(wanted / ratio) : wanted;
  const rx60::ToolPoint tool = rx60::toolPoint(bounds.geometry, bounds.tool_e, q);
  const double share = bounds.share(tool.manipulability);
  const double shared_ratio = bounds.speedRatio(target) / (share < 1.0 ? kAim * share : 1.0);
  if (share < 1.0 && shared_ratio > 1.0) {
    out.singular = true;
    target /= shared_ratio;
  }
  const double tool_ratio = (tool.fJ * target).norm() / (kAim * bounds.tool_speed);
  if (tool_ratio > 1.0) {
    out.tool_speed = true;
    target /= tool_ratio;
  }
  return target;
}

/// One period's choice: how far towards the target.
struct Step {
  JointRates from;
  JointVector target;  ///< [rad/s]
  JointVector change;  ///< of the target [rad/s^2]

  /// Steps towards that share of the target; share 0 brakes.
  [[nodiscard]] JointRates share(double part, const StopBounds& bounds) const {
    JointRates next;
    for (std::size_t i = 0; i < 6; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      next[i] = part > 0.0
                    ? stepTowards(from[i], part * target(row), part * change(row), bounds.joints[i])
                    : brakingStep(from[i], bounds.joints[i]);
    }
    return next;
  }
};

/// How fast the target moves by itself [rad/s^2]; zero where it jumps.
JointVector steadyChange(const JointVector& difference, const StopBounds& bounds) {
  JointVector change;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double rate = difference(row) / bounds.joints[i].period_s;
    change(row) = std::abs(rate) <= bounds.joints[i].acceleration ? rate : 0.0;
  }
  return change;
}

void flag(BrokenLimit broken, LimitedVelocity& out) {
  out.position = out.position || broken == BrokenLimit::kPosition;
  out.tool_speed = out.tool_speed || broken == BrokenLimit::kToolSpeed;
  out.singular = out.singular || broken == BrokenLimit::kSingular;
  out.workspace = out.workspace || broken == BrokenLimit::kWorkspace;
}

/// Greatest share of the target, as far as bisection finds it, after which braking keeps all
/// limits.
double greatestShare(const Step& step, const StopBounds& bounds, const JointPlace& place,
                     LimitedVelocity& out) {
  const BrokenLimit broken = firstBroken(bounds, place, step.share(1.0, bounds));
  if (broken == BrokenLimit::kNone) {
    return 1.0;
  }
  flag(broken, out);
  double good = 0.0;
  double bad = 1.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (good + bad);
    const BrokenLimit then = firstBroken(bounds, place, step.share(middle, bounds));
    (then == BrokenLimit::kNone ? good : bad) = middle;
  }
  return good;
}

/// Acceleration and jerk bent a step that missed its target.
void flagRates(const JointRates& taken, const JointVector& target, const StopBounds& bounds,
               LimitedVelocity& out) {
  for (std::size_t i = 0; i < 6; ++i) {
    if (std::abs(taken[i].velocity - target(static_cast<Eigen::Index>(i))) > kSame) {
      const bool full = std::abs(taken[i].acceleration) >= bounds.joints[i].acceleration;
      (full ? out.acceleration : out.jerk) = true;
    }
  }
}

}  // namespace

Limiter::Limiter(const LimiterSettings& settings) : settings_(settings) {
  check(settings);
  reset();
}

void Limiter::reset() {
  place_known_ = false;
  velocity_.setZero();
  acceleration_.setZero();
  target_.setZero();
  sent_.fill(JointVector::Zero());
}

JointLimits Limiter::reach() const {
  JointLimits limits = settings_.limits;
  limits.lower.array() += settings_.position_margin_rad;
  limits.upper.array() -= settings_.position_margin_rad;
  return limits;
}

bool Limiter::atRest() const {
  return velocity_.cwiseAbs().maxCoeff() < kSame && acceleration_.cwiseAbs().maxCoeff() < 1e-6;
}

bool Limiter::observe(const JointVector& measured) {
  const JointVector slack = JointVector::Constant(settings_.jump_rad);
  const bool possible = measured.allFinite() &&
                        (measured.array() >= (settings_.limits.lower - slack).array()).all() &&
                        (measured.array() <= (settings_.limits.upper + slack).array()).all();
  if (!possible) {
    place_.low = place_.high = place_.estimate;
    return false;
  }
  if (!place_known_) {
    place_.estimate = place_.low = place_.high = measured;
    place_known_ = true;
    return true;
  }
  // How far the commands of the last periods can have run ahead of the measurement.
  JointVector ahead = JointVector::Zero();
  JointVector least = ahead;
  JointVector most = ahead;
  for (int k = 0; k < settings_.lag_periods; ++k) {
    ahead += settings_.period_s * sent_[static_cast<std::size_t>(k)];
    least = least.cwiseMin(ahead);
    most = most.cwiseMax(ahead);
  }
  const JointVector explained =
      (place_.estimate - measured).cwiseMax(least).cwiseMin(most) + measured;
  if ((explained - place_.estimate).cwiseAbs().maxCoeff() > settings_.jump_rad) {
    if (atRest()) {
      place_.estimate = measured;  // believed once the next measurement agrees
    }
    place_.low = place_.high = place_.estimate;
    return false;
  }
  place_ = {explained, explained.cwiseMin(measured), explained.cwiseMax(measured)};
  return true;
}

StopBounds Limiter::boundsNow(OperatingMode mode) const {
  const LimiterSettings& s = settings_;
  StopBounds bounds;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    bounds.joints[i] = {s.velocity_fraction * s.limits.velocity(row), s.limits.acceleration(row),
                        s.limits.jerk(row) * s.period_s, s.period_s};
  }
  const JointLimits within_margin = reach();
  bounds.lower = within_margin.lower;
  bounds.upper = within_margin.upper;
  bounds.tool_speed = kBetweenEnds * (mode == OperatingMode::kManual ? s.tool_speed_manual_m_s
                                                                     : s.tool_speed_automatic_m_s);
  bounds.box = s.box;
  bounds.geometry = s.geometry;
  bounds.tool_e = s.tool_e;
  bounds.singular_below = s.singular_below;
  bounds.least_share = s.least_share;
  return bounds;
}

JointRates Limiter::rates() const {
  JointRates rates;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    rates[i] = {velocity_(row), acceleration_(row)};
  }
  return rates;
}

void Limiter::remember(const JointRates& rates, const JointVector& target) {
  for (std::size_t i = 0; i < 6; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    velocity_(row) = rates[i].velocity;
    acceleration_(row) = rates[i].acceleration;
  }
  target_ = target;
  std::shift_right(sent_.begin(), sent_.end(), 1);
  sent_[0] = velocity_;
  place_.estimate += settings_.period_s * velocity_;
}

LimitedVelocity Limiter::limit(const JointVector& wanted, const JointVector& measured,
                               OperatingMode mode) {
  LimitedVelocity out;
  const bool seen = observe(measured);
  out.bad_input = !seen || !wanted.allFinite();
  if (!place_known_) {
    return out;
  }
  const StopBounds bounds = boundsNow(mode);
  Step step{rates(), JointVector::Zero(), JointVector::Zero()};
  if (!out.bad_input) {
    step.target = shorten(wanted, bounds, place_.estimate, out);
    step.change = steadyChange(step.target - target_, bounds);
  }
  const double share = out.bad_input ? 0.0 : greatestShare(step, bounds, place_, out);
  const JointRates taken = step.share(share, bounds);
  flagRates(taken, share * step.target, bounds, out);
  remember(taken, share * step.target);
  out.velocity = velocity_;
  return out;
}

}  // namespace ringhook
