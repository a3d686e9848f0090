#pragma once

/// \file
/// A point that moves with nearly constant acceleration: the 2007 report's model of the belt
/// (Jeyabalan, Fork project, section 5.1). State (5.1): x = (p, v, a), nine numbers. Law:
///   p' = p + v dt + a dt^2/2 (5.2)    v' = v + a dt (5.3)    a' = a (5.4)
/// The report prints the transition (5.5) for dt = 1 s; here dt is free and may be negative.
/// Process noise two ways: white jerk of density q [m^2/s^5] integrated over dt (Bar-Shalom, Li,
/// Kirubarajan, 2001, section 6.2.3), right for any dt; and the report's way, a constant diagonal
/// matrix chosen by trial (section 6.3.3), which belongs to one fixed dt.

#include <Eigen/Core>
#include <optional>

#include "core/outcome.h"
#include "core/time.h"
#include "prediction/linear_kalman.h"

namespace ringhook {

using Vector9 = Eigen::Matrix<double, 9, 1>;  ///< p [m], v [m/s], a [m/s^2]
using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Matrix39 = Eigen::Matrix<double, 3, 9>;

/// Transition (5.5) over `dt` [s].
Matrix9 accelerationTransition(double dt);

/// Noise that white jerk of density `jerk_density` [m^2/s^5] leaves after |dt| [s], per axis alike:
/// q [dt^5/20 dt^4/8 dt^3/6; . dt^3/3 dt^2/2; . . dt].
Matrix9 jerkNoise(double dt, double jerk_density);

/// The report's noise: diagonal, the same for every step. Standard deviations per axis and step of
/// position [m], velocity [m/s] and acceleration [m/s^2].
Matrix9 reportNoise(double sigma_position, double sigma_velocity, double sigma_acceleration);

/// Measurement matrix C of the position: y = p.
Matrix39 positionMeasurement();

struct ConstantAccelerationOptions {
  double jerk_density = 1e-2;          ///< white jerk [m^2/s^5]
  std::optional<Matrix9> fixed_noise;  ///< per step, instead of white jerk: the report's way
  double speed_sigma = 0.5;            ///< prior of each velocity component, mean 0 [m/s]
  double acceleration_sigma = 1.0;     ///< prior of each acceleration component, mean 0 [m/s^2]
  double gate_probability = 0.0;       ///< of a good measurement to pass, in (0, 1); 0: no gate
};

/// Filter of one point. Not before the first measurement is there a belief.
class ConstantAccelerationFilter {
 public:
  explicit ConstantAccelerationFilter(const ConstantAccelerationOptions& options);

  /// Position [m] with covariance [m^2] at `time`. Refuses "not finite", "late or duplicate time
  /// stamp", "outside the gate"; the belief stays as it was.
  Outcome<FilterUpdate> update(Time time, const Eigen::Vector3d& position,
                               const Eigen::Matrix3d& covariance);

  /// Belief at `time`, later or slightly earlier; refuses "no measurement yet".
  [[nodiscard]] Outcome<Gaussian<9>> predict(Time time) const;

 private:
  [[nodiscard]] Gaussian<9> ahead(Time time) const;

  ConstantAccelerationOptions options_;
  double gate_ = 0.0;  ///< on the NIS; 0: none
  std::optional<Time> time_;
  Gaussian<9> belief_;
};

}  // namespace ringhook
