#pragma once

/// \file
/// A pendulum's length and damping from the first seconds of its swing, which is what a linear
/// filter must be told before it can begin. Least squares on what was seen, nothing later:
///   offset(t) = driven(t) + b1 C(t) + b2 S(t) [+ offset [+ drift t]]
/// with C, S the free swings that begin with unit angle and unit rate (exact_pendulum.h), which
/// hold stiffness g/L and damping c; b and the rest stand linearly (variable projection: Golub and
/// Pereyra, SIAM J. Numerical Analysis 10, 1973). A grid over lengths from 1 cm to 30 m finds the
/// valley, Levenberg-Marquardt its bottom. Angles have no offset; a point with a measured pivot has
/// one per axis and is driven by the pivot, which is followed as a line between samples, so that
/// its jerks at the samples act and nothing is differentiated twice; of a point alone the pivot is
/// taken to travel evenly.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/time.h"
#include "prediction/motion_model.h"

namespace ringhook {

/// What was seen: axes alike, each with its own amplitude and phase.
struct SwingRecord {
  std::vector<double> time_s;               ///< since any instant, growing [s]
  std::vector<std::vector<double>> axes;    ///< [axis][sample], angle [rad] or position [m]
  std::vector<std::vector<double>> pivots;  ///< the same of the pivot [m]; empty: not measured
  int free_columns = 0;                     ///< 0: none, 1: an offset, 2: and a drift
};

struct PendulumFit {
  double length_m = 0.0;             ///< effective
  double length_sigma_m = 0.0;       ///< from the residuals, taken as white
  double damping_per_s = 0.0;        ///< c of phi'' = -(g/L) phi - c phi', >= 0
  double damping_sigma_per_s = 0.0;  ///< standard deviation
  double residual = 0.0;             ///< root mean square [rad or m]
  double explained = 0.0;            ///< share of the squares that the swing takes away
  double periods = 0.0;              ///< of this pendulum in the time seen
};

/// Refuses "too few samples" (under eight) and "no swing to be seen".
Outcome<PendulumFit> fitPendulum(const SwingRecord& record, double gravity);

/// Gathers samples until one period was seen, the swing explains three quarters of what moved, and
/// the length is known within 5 %.
class PendulumStart {
 public:
  PendulumStart(TrajectoryKind kind, double gravity);

  /// Fits anew whenever what was seen grew by a tenth.
  std::optional<PendulumFit> add(Time time, const Eigen::VectorXd& value);

 private:
  void forgetOld();

  TrajectoryKind kind_;
  double gravity_;
  std::vector<Time> times_;
  std::vector<Eigen::VectorXd> values_;
  double next_s_ = 0.0;  ///< length of record to fit next
};

}  // namespace ringhook
