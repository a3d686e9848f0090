#include "limit_watch.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <numeric>

namespace ringhook {
namespace {

constexpr double kTolerance = 1e-9;

/// Greatest ratio of |value| to its limit.
double use(const JointVector& value, const JointVector& limit) {
  return value.cwiseAbs().cwiseQuotient(limit).maxCoeff();
}

}  // namespace

long WatchResult::total() const { return std::accumulate(broken.begin(), broken.end(), 0L); }

void WatchResult::add(const WatchResult& other) {
  for (std::size_t i = 0; i < broken.size(); ++i) {
    broken[i] += other.broken[i];
    most[i] = std::max(most[i], other.most[i]);
  }
}

void LimitWatch::note(Watched what, double used) {
  result_.most[what] = std::max(result_.most[what], used);
  result_.broken[what] += used <= 1.0 + kTolerance ? 0 : 1;
}

/// Beyond a limit only an arm that was beyond it already may be, and no further than before.
void LimitWatch::noteDistance(Watched what, double beyond, double beyond_before) {
  if (beyond_before <= kTolerance) {
    result_.most[what] = std::max(result_.most[what], beyond);
  }
  result_.broken[what] += beyond <= std::max(0.0, beyond_before) + kTolerance ? 0 : 1;
}

double LimitWatch::toolSpeed(const JointVector& q, const JointVector& v) const {
  const Twist twist = rx60::jacobian(s_.geometry, q) * v;
  const Eigen::Vector3d arm = rx60::forward(s_.geometry, q).linear() * s_.tool_e;
  return (twist.head<3>() + twist.tail<3>().cross(arm)).norm();
}

double LimitWatch::singularUse(const JointVector& q, const JointVector& v) const {
  const double w = std::abs(rx60::jacobian(s_.geometry, q).determinant());
  const double share =
      s_.least_share + (1.0 - s_.least_share) * std::min(1.0, w / s_.singular_below);
  return use(v, share * s_.velocity_fraction * s_.limits.velocity);
}

void LimitWatch::see(const JointVector& q, const JointVector& v, double tool_limit) {
  if (!v.allFinite()) {
    ++result_.broken[kFinite];
    return;
  }
  const JointVector after = q + s_.period_s * v;
  const JointVector middle = q + 0.5 * s_.period_s * v;
  note(kSpeed, use(v, s_.velocity_fraction * s_.limits.velocity));
  note(kAcceleration, use((v - before_) / s_.period_s, s_.limits.acceleration));
  note(kJerk,
       use((v - 2.0 * before_ + long_before_) / (s_.period_s * s_.period_s), s_.limits.jerk));
  for (const JointVector& at : {q, middle, after}) {
    note(kTool, toolSpeed(at, v) / tool_limit);
  }
  note(kSingular, singularUse(q, v));
  note(kSingular, singularUse(after, v));
  for (int i = 0; i < 6; ++i) {
    noteDistance(kPosition, after(i) - s_.limits.upper(i), q(i) - s_.limits.upper(i));
    noteDistance(kPosition, s_.limits.lower(i) - after(i), s_.limits.lower(i) - q(i));
  }
  const Eigen::Vector3d from = rx60::forward(s_.geometry, q) * s_.tool_e;
  const Eigen::Vector3d to = rx60::forward(s_.geometry, after) * s_.tool_e;
  for (int i = 0; i < 3; ++i) {
    noteDistance(kBox, to(i) - s_.box.upper(i), from(i) - s_.box.upper(i));
    noteDistance(kBox, s_.box.lower(i) - to(i), s_.box.lower(i) - from(i));
  }
  long_before_ = before_;
  before_ = v;
}

}  // namespace ringhook
