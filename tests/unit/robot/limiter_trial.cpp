#include "limiter_trial.h"

#include <cmath>

namespace ringhook {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kPeriodsToBrake = 150;  // from automatic to manual speed: 0.6 s, twice what is needed

/// A jump, and what the fastest joint covers in the longest lag [rad].
constexpr double kCredible = 0.1 + 4.0 * 0.05;

}  // namespace

LimiterTrial::LimiterTrial(unsigned long seed) : engine_(seed) {
  settings_ = randomSettings();
  q_ = randomStart();
  held_ = JointVector::Zero();
  if (below(3) == 0) {
    surround();
  }
}

JointVector LimiterTrial::vector() {
  return JointVector::NullaryExpr([this] { return unit(); });
}

double LimiterTrial::garbage() {
  const double all[] = {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity, 1e300,
                        -std::numeric_limits<double>::max(),      1e-310,    -0.0};
  return all[below(7)];
}

LimiterSettings LimiterTrial::randomSettings() {
  LimiterSettings settings;
  settings.geometry = below(2) == 0 ? rx60::rx60() : rx60::rx60L();
  settings.velocity_fraction = below(2) == 0 ? 1.0 : 0.525 + 0.475 * unit();
  if (below(2) == 0) {
    settings.tool_e = 0.15 * Eigen::Vector3d(unit(), unit(), unit());
  }
  settings.lag_periods = below(5);
  return settings;
}

/// Anywhere; sometimes near a limit, or a little beyond it.
JointVector LimiterTrial::randomStart() {
  const JointLimits& limits = settings_.limits;
  JointVector q = 0.5 * (limits.upper + limits.lower) +
                  0.5 * (limits.upper - limits.lower).cwiseProduct(vector());
  const int joint = below(12);
  if (joint < 6) {
    q(joint) = limits.upper(joint) + 0.05 * unit();
  }
  return q;
}

/// A box about the tool, or beside it: then the tool starts outside.
void LimiterTrial::surround() {
  const Eigen::Vector3d tool = rx60::forward(settings_.geometry, q_) * settings_.tool_e;
  for (int i = 0; i < 3; ++i) {
    const double upper = tool(i) + 0.2 + 0.25 * unit();
    if (below(4) != 0) {
      settings_.box.upper(i) = upper;
    }
    if (below(4) != 0) {
      settings_.box.lower(i) = upper - 0.3 + 0.27 * unit();
    }
  }
}

JointVector LimiterTrial::wanted(long k) {
  if (below(80) == 0) {
    kind_ = below(8);
    held_ = std::pow(10.0, 3.0 * unit()) * vector().cwiseProduct(settings_.limits.velocity);
  }
  JointVector wanted = held_;
  switch (kind_) {
    case 0:
      return std::sin(0.02 * static_cast<double>(k)) * held_;
    case 1:
      return (k % 2 == 0 ? 1e3 : -1e3) * held_;
    case 2:
      return std::pow(10.0, 2.0 * unit()) * vector();
    case 3:
      wanted(below(6)) = garbage();
      return wanted;
    case 4:
      return JointVector::Unit(below(6)) * 1e300 * unit();
    case 5:
      return below(10) == 0 ? JointVector::Constant(garbage()) : held_;
    case 6:
      return held_ + 0.05 * vector();
    default:
      return held_;
  }
}

/// What the limiter is told: the truth, and now and then nonsense. A false place so near that the
/// arm could be there, or one that is repeated while it rests, nothing could tell from a true one.
JointVector LimiterTrial::measured() {
  JointVector q = q_;
  switch (told_nonsense_ ? -1 : below(400)) {
    case 0:
      q(below(6)) = garbage();
      break;
    case 1:
      q = randomStart();
      break;
    case 2:
      q = JointVector::Constant(garbage());
      break;
    default:
      break;
  }
  told_nonsense_ = !q.allFinite() || (q - q_).cwiseAbs().maxCoeff() > kCredible;
  return told_nonsense_ ? q : q_;
}

WatchResult LimiterTrial::run(long inputs) {
  Limiter limiter(settings_);
  LimitWatch watch(settings_);
  bool manual = below(2) == 0;
  long manual_since = manual ? -kPeriodsToBrake : 0;
  // The first measurement is the truth: nothing else is known then.
  (void)limiter.limit(JointVector::Zero(), q_);
  for (long k = 0; k < inputs; ++k) {
    if (below(300) == 0) {
      manual = !manual;
      manual_since = k;
    }
    const JointVector v = limiter
                              .limit(wanted(k), measured(),
                                     manual ? OperatingMode::kManual : OperatingMode::kAutomatic)
                              .velocity;
    const bool slow = manual && k - manual_since >= kPeriodsToBrake;
    watch.see(q_, v, slow ? settings_.tool_speed_manual_m_s : settings_.tool_speed_automatic_m_s);
    if (!v.allFinite()) {
      break;  // nothing can be said of what follows
    }
    q_ += settings_.period_s * v;
  }
  return watch.result();
}

}  // namespace ringhook
