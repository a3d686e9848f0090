#include <algorithm>
#include <cmath>

#include "calib/solve/time_delay.h"

namespace ringhook {
namespace {

constexpr double kEarliest = -0.010;  // shifts that are looked at [s]
constexpr double kLatest = 0.120;
constexpr double kCoarse = 0.001;      // step of the first look [s]
constexpr double kFine = 1e-5;         // step for the parabola [s]
constexpr double kLeastMotion = 1e-3;  // of a joint that counts, standard deviation [rad]
constexpr double kExplained = 0.9;     // share of the motion that commands must explain
constexpr double kBlock = 0.2;         // of states whose errors may be of one kind [s]

/// Commands added up: where the joints would be if each acted from its stamp until the next.
class Commanded {
 public:
  explicit Commanded(const std::vector<SentVelocity>& sent) : sent_(sent) {
    place_.push_back(JointVector::Zero());
    for (std::size_t i = 1; i < sent.size(); ++i) {
      place_.push_back(place_.back() +
                       (sent[i].stamp - sent[i - 1].stamp) * sent[i - 1].joint_velocity);
    }
  }

  /// Before the first command at rest; within a last one it acts on.
  [[nodiscard]] JointVector at(Time time) const {
    const auto after = std::upper_bound(sent_.begin(), sent_.end(), time,
                                        [](Time t, const SentVelocity& s) { return t < s.stamp; });
    if (after == sent_.begin()) {
      return place_.front();
    }
    const auto i = static_cast<std::size_t>(after - sent_.begin()) - 1;
    return place_[i] + (time - sent_[i].stamp) * sent_[i].joint_velocity;
  }

 private:
  const std::vector<SentVelocity>& sent_;
  std::vector<JointVector> place_;
};

/// Sums of squares of all joints: of the motion, and of what the commands leave of it.
struct Explained {
  double motion = 0.0;       ///< [rad^2]
  double remaining = 0.0;    ///< [rad^2]
  Eigen::MatrixXd residual;  ///< a row for each state, a column for each joint [rad]
};

/// The joints as a + g * commanded(t - shift), a and g by least squares.
Explained explain(const Commanded& commanded, const std::vector<ArmState>& states, double shift) {
  const auto n = static_cast<Eigen::Index>(states.size());
  Eigen::MatrixXd q(n, 6);
  Eigen::MatrixXd c(n, 6);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ArmState& state = states[static_cast<std::size_t>(i)];
    q.row(i) = state.position.transpose();
    c.row(i) = commanded.at(state.time - shift).transpose();
  }
  q.rowwise() -= q.colwise().mean().eval();
  c.rowwise() -= c.colwise().mean().eval();
  Explained result;
  result.residual = Eigen::MatrixXd::Zero(n, 6);
  for (int j = 0; j < 6; ++j) {
    const double motion = q.col(j).squaredNorm();
    const double power = c.col(j).squaredNorm();
    if (motion < static_cast<double>(n) * kLeastMotion * kLeastMotion || !(power > 0.0)) {
      continue;
    }
    const double gain = q.col(j).dot(c.col(j)) / power;
    result.residual.col(j) = q.col(j) - gain * c.col(j);
    result.motion += motion;
    result.remaining += result.residual.col(j).squaredNorm();
  }
  return result;
}

/// By blocks of time, as neighbouring states err alike.
double shiftSigma(const Commanded& commanded, const std::vector<ArmState>& states, double shift,
                  const Eigen::MatrixXd& residual) {
  const Eigen::MatrixXd slope = (explain(commanded, states, shift + kFine).residual -
                                 explain(commanded, states, shift - kFine).residual) /
                                (2.0 * kFine);
  double spread = 0.0;
  double block = 0.0;
  Time end = states.front().time + kBlock;
  for (Eigen::Index i = 0; i < residual.rows(); ++i) {
    if (states[static_cast<std::size_t>(i)].time >= end) {
      spread += block * block;
      block = 0.0;
      end = end + kBlock;
    }
    block += slope.row(i).dot(residual.row(i));
  }
  return std::sqrt(spread + block * block) / slope.squaredNorm();
}

}  // namespace

Outcome<ResponseDelay> findResponseDelay(const std::vector<SentVelocity>& sent,
                                         const std::vector<ArmState>& states) {
  if (sent.size() < 100 || states.size() < 100) {
    return Refusal{"too few commands and states"};
  }
  const Commanded commanded(sent);
  double best = kEarliest;
  Explained least = explain(commanded, states, best);
  if (!(least.motion > 0.0)) {
    return Refusal{"the joints hardly moved"};
  }
  for (double shift = kEarliest + kCoarse; shift <= kLatest; shift += kCoarse) {
    Explained here = explain(commanded, states, shift);
    if (here.remaining < least.remaining) {
      best = shift;
      least = std::move(here);
    }
  }
  // The bottom of the parabola through three neighbours.
  const double before = explain(commanded, states, best - kCoarse).remaining;
  const double after = explain(commanded, states, best + kCoarse).remaining;
  const double curvature = before - 2.0 * least.remaining + after;
  if (curvature > 0.0) {
    best += 0.5 * kCoarse * (before - after) / curvature;
    least = explain(commanded, states, best);
  }
  if (!(least.remaining < (1.0 - kExplained) * least.motion)) {
    return Refusal{"the joints do not follow the commands"};
  }
  ResponseDelay found;
  found.delay_s = best;
  found.rms_rad = std::sqrt(least.remaining / static_cast<double>(6 * states.size()));
  found.sigma_s = shiftSigma(commanded, states, best, least.residual);
  return found;
}

}  // namespace ringhook
