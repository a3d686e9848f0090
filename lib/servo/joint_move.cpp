#include "servo/joint_move.h"

#include <algorithm>
#include <cstdio>

#include "servo/quintic.h"

namespace ringhook {
namespace {

constexpr double kRounding = 1e-9;  ///< a joint standing on its limit [rad]

}  // namespace

Outcome<JointMove> planJointMove(const JointVector& start, const JointVector& end,
                                 const JointLimits& limits, double fraction) {
  if (!start.allFinite() || !end.allFinite()) {
    return Refusal{"joint move has an end that is not finite"};
  }
  if (!(fraction > 0.0 && fraction <= 1.0)) {
    return Refusal{"fraction of the joint limits must be above 0 and at most 1"};
  }
  JointMove move{start, end, 0.0};
  for (int i = 0; i < 6; ++i) {
    if (end(i) > limits.upper(i) + kRounding || end(i) < limits.lower(i) - kRounding) {
      char text[80];
      std::snprintf(text, sizeof text, "joint move ends outside the limits of J%d", i + 1);
      return Refusal{text};
    }
    const double needed =
        quinticDuration(std::abs(end(i) - start(i)), fraction * limits.velocity(i),
                        fraction * limits.acceleration(i));
    move.duration_s = std::max(move.duration_s, needed);
  }
  return move;
}

JointSample sampleJointMove(const JointMove& move, double t) {
  const QuinticSample at = quinticAt(t, move.duration_s);
  const JointVector distance = move.end - move.start;
  return {move.start + at.progress * distance, at.rate_per_s * distance};
}

JointVector trackJointMove(const JointMove& move, double t, const JointVector& q,
                           double gain_per_s) {
  const JointSample sample = sampleJointMove(move, t);
  return sample.velocity + gain_per_s * (sample.position - q);
}

}  // namespace ringhook
