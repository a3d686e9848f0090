#pragma once

/// \file
/// Judges what left the limiter by other means than its own: finite differences of the velocities,
/// link-frame kinematics and the determinant of the Jacobian.
/// Tolerance: 1e-9 of each limit. Second differences of speeds up to 12 rad/s over 4 ms carry
/// rounding of 1e-9 rad/s^3 and some 1e-12 of the jerk limits; positions and tool places round at
/// 1e-15. Anything beyond is a broken limit.

#include <array>

#include "robot/limiter.h"

namespace ringhook {

enum Watched { kFinite, kPosition, kSpeed, kAcceleration, kJerk, kTool, kSingular, kBox };
inline constexpr std::array<const char*, 8> kWatchedNames = {
    "finite", "position", "speed", "acceleration", "jerk", "tool speed", "singular", "box"};

/// How often each limit broke, and the greatest share of it that was ever used (of position and
/// box: the greatest distance beyond [rad], [m]).
struct WatchResult {
  std::array<long, 8> broken{};
  std::array<double, 8> most{};
  WatchResult() { most[kPosition] = most[kBox] = -1e9; }
  [[nodiscard]] long total() const;
  void add(const WatchResult& other);
};

class LimitWatch {
 public:
  explicit LimitWatch(const LimiterSettings& settings) : s_(settings) {}

  /// The arm at q [rad] goes at v [rad/s] for one period. `tool_limit` [m/s] is what holds then.
  void see(const JointVector& q, const JointVector& v, double tool_limit);
  [[nodiscard]] const WatchResult& result() const { return result_; }

 private:
  void note(Watched what, double used);
  void noteDistance(Watched what, double beyond, double beyond_before);
  [[nodiscard]] double toolSpeed(const JointVector& q, const JointVector& v) const;
  [[nodiscard]] double singularUse(const JointVector& q, const JointVector& v) const;

  LimiterSettings s_;
  JointVector before_ = JointVector::Zero();       ///< velocity one period ago [rad/s]
  JointVector long_before_ = JointVector::Zero();  ///< and two
  WatchResult result_;
};

}  // namespace ringhook
