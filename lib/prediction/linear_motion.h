#pragma once

/// \file
/// Motion models that are linear filters of their axes, and the two plain ones: nearly constant
/// velocity, and nearly constant acceleration (the 2007 report's belt, Jeyabalan, Fork project,
/// equations 5.1 to 5.5). Neither knows of gravity or of a pivot, so a measured pivot is not used.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "prediction/axis_filters.h"
#include "prediction/motion_model.h"

namespace ringhook {

/// Groups of axes that together fill a prediction.
class LinearMotion final : public MotionModel {
 public:
  struct Label {
    std::string name;
    std::string note;
    std::vector<NamedParameter> parameters;
  };
  LinearMotion(TrajectoryKind kind, Label label, std::vector<std::unique_ptr<AxisGroup>> groups);

  [[nodiscard]] std::string name() const override { return label_.name; }
  Outcome<FilterUpdate> update(Time time, const Eigen::VectorXd& value) override;
  [[nodiscard]] Outcome<Gaussian<Eigen::Dynamic>> predict(Time time) const override;
  [[nodiscard]] std::vector<NamedParameter> parameters() const override {
    return label_.parameters;
  }
  [[nodiscard]] std::string note() const override { return label_.note; }

 private:
  TrajectoryKind kind_;
  Label label_;
  std::vector<std::unique_ptr<AxisGroup>> groups_;
  std::optional<Time> time_;  ///< of the last sample
};

struct PlainMotionOptions {
  double sample_sigma = 1e-3;  ///< measurement noise of each number [rad or m], > 0
  double density = 1.0;  ///< white acceleration [rad^2/s^3 or m^2/s^3], or white jerk [.../s^5]
};

/// "constant-velocity".
std::unique_ptr<MotionModel> makeConstantVelocity(TrajectoryKind kind,
                                                  const PlainMotionOptions& options);
/// "constant-acceleration".
std::unique_ptr<MotionModel> makeConstantAcceleration(TrajectoryKind kind,
                                                      const PlainMotionOptions& options);

/// Their laws for one coordinate, over `dt` >= 0 [s]; `density` as in the options.
AxisStep<2> velocityStep(double dt, double density);
AxisStep<3> accelerationStep(double dt, double density);

/// A coordinate of nearly constant velocity that is measured itself.
AxisLaw<2, 1> constantVelocityLaw(const PlainMotionOptions& options);

}  // namespace ringhook
