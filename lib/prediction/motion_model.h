#pragma once

/// \file
/// The one interface through which trajectories are judged: a model is given samples in the order
/// of their times and asked where the trajectory will be. It is causal by construction: it knows
/// the samples that it was given and nothing else.
/// Four kinds of trajectory. A swing about a fixed pivot is one angle or two, hanging = 0 [rad]; a
/// point is (x, y, z) [m] in a frame that does not turn and whose z axis points up; a point whose
/// pivot was measured as well is six numbers, the point and then the pivot, in the same frame.
/// What is predicted has the coordinates of the angles or of the point, never of the pivot.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/outcome.h"
#include "core/time.h"
#include "prediction/linear_kalman.h"

namespace ringhook {

enum class TrajectoryKind { kAngle, kTwoAngles, kPoint, kPointAndPivot };

/// Numbers in one sample: 1, 2 [rad], 3 or 6 [m].
constexpr int valueSize(TrajectoryKind kind) {
  constexpr int kSizes[] = {1, 2, 3, 6};
  return kSizes[static_cast<int>(kind)];
}

/// Numbers in one prediction: 1, 2 [rad], 3 or 3 [m].
constexpr int predictedSize(TrajectoryKind kind) {
  return kind == TrajectoryKind::kPointAndPivot ? 3 : valueSize(kind);
}

/// True for the kinds that are angles.
constexpr bool isAngular(TrajectoryKind kind) {
  return kind == TrajectoryKind::kAngle || kind == TrajectoryKind::kTwoAngles;
}

/// Something that a model knows of the world beside its state.
struct NamedParameter {
  std::string key;     ///< with its unit: "length_m", "damping_per_s"
  double value = 0.0;  ///< in the key's unit
  double sigma = 0.0;  ///< standard deviation; 0 for a value that was given and is not estimated
};

class MotionModel {
 public:
  MotionModel() = default;
  virtual ~MotionModel() = default;
  MotionModel(const MotionModel&) = delete;
  MotionModel& operator=(const MotionModel&) = delete;

  /// As in --models: "constant-velocity".
  [[nodiscard]] virtual std::string name() const = 0;

  /// Takes a sample of valueSize() numbers; how good it is stands in the model's options. The
  /// update has 0 degrees of freedom while the model gathers what it starts from. Refuses, and
  /// changes nothing: "not finite", "late or duplicate time stamp"; gates may refuse as well.
  virtual Outcome<FilterUpdate> update(Time time, const Eigen::VectorXd& value) = 0;

  /// Belief about the angles or the point at `time`, not before the last sample: predictedSize()
  /// numbers. Refuses "no measurement yet" and "not started yet".
  [[nodiscard]] virtual Outcome<Gaussian<Eigen::Dynamic>> predict(Time time) const = 0;

  /// As believed now; empty for a model that has none, or none yet.
  [[nodiscard]] virtual std::vector<NamedParameter> parameters() const { return {}; }

  /// How its parameters and noise values came about, as half a sentence; empty: nothing to tell.
  [[nodiscard]] virtual std::string note() const { return {}; }
};

}  // namespace ringhook
