#include "prediction/linear_motion.h"

#include <array>
#include <cassert>
#include <utility>

#include "prediction/constant_acceleration.h"
#include "prediction/constant_velocity.h"

namespace ringhook {
namespace {

// Before the first sample: nothing that moves among people is farther or faster (mean 0).
constexpr double kFar = 1e3;      // [rad or m]
constexpr double kFast = 20.0;    // [rad/s or m/s]
constexpr double kHasty = 200.0;  // [rad/s^2 or m/s^2]

/// Each predicted number is measured itself.
std::vector<AxisPlace<1>> ownPlaces(TrajectoryKind kind) {
  std::vector<AxisPlace<1>> places;
  places.reserve(static_cast<std::size_t>(predictedSize(kind)));
  for (int i = 0; i < predictedSize(kind); ++i) {
    places.push_back({{i}, i});
  }
  return places;
}

template <int N>
std::unique_ptr<MotionModel> plainMotion(TrajectoryKind kind, const char* name, AxisLaw<N, 1> law) {
  std::vector<std::unique_ptr<AxisGroup>> groups;
  groups.push_back(std::make_unique<AxisFilters<N, 1>>(std::move(law), ownPlaces(kind)));
  return std::make_unique<LinearMotion>(kind, LinearMotion::Label{name, "", {}}, std::move(groups));
}

}  // namespace

LinearMotion::LinearMotion(TrajectoryKind kind, Label label,
                           std::vector<std::unique_ptr<AxisGroup>> groups)
    : kind_(kind), label_(std::move(label)), groups_(std::move(groups)) {}

Outcome<FilterUpdate> LinearMotion::update(Time time, const Eigen::VectorXd& value) {
  assert(value.size() == valueSize(kind_));
  if (!value.allFinite()) {
    return Refusal{"not finite"};
  }
  if (time_ && time <= *time_) {
    return Refusal{"late or duplicate time stamp"};
  }
  FilterUpdate all{time, 0.0, 0};
  for (const auto& group : groups_) {
    const FilterUpdate one = group->update(time, value);
    all.nis += one.nis;
    all.degrees += one.degrees;
  }
  time_ = time;
  return all;
}

Outcome<Gaussian<Eigen::Dynamic>> LinearMotion::predict(Time time) const {
  if (!time_) {
    return Refusal{"no measurement yet"};
  }
  const int size = predictedSize(kind_);
  Gaussian<Eigen::Dynamic> belief{Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size)};
  for (const auto& group : groups_) {
    group->predict(time, belief);
  }
  return belief;
}

AxisStep<2> velocityStep(double dt, double density) {
  return {velocityTransition(dt), whiteAccelerationNoise(dt, density)};
}

AxisStep<3> accelerationStep(double dt, double density) {
  constexpr std::array<int, 3> kAxis = {0, 3, 6};  // of the nine states, (p, v, a) of three axes
  return {accelerationTransition(dt)(kAxis, kAxis), jerkNoise(dt, density)(kAxis, kAxis)};
}

AxisLaw<2, 1> constantVelocityLaw(const PlainMotionOptions& options) {
  AxisLaw<2, 1> law;
  law.step = [q = options.density](double dt) { return velocityStep(dt, q); };
  law.measured << 1.0, 0.0;
  law.wanted = law.measured;
  law.prior_sigma << kFar, kFast;
  law.sample_sigma = options.sample_sigma;
  return law;
}

std::unique_ptr<MotionModel> makeConstantVelocity(TrajectoryKind kind,
                                                  const PlainMotionOptions& options) {
  return plainMotion<2>(kind, "constant-velocity", constantVelocityLaw(options));
}

std::unique_ptr<MotionModel> makeConstantAcceleration(TrajectoryKind kind,
                                                      const PlainMotionOptions& options) {
  AxisLaw<3, 1> law;
  law.step = [q = options.density](double dt) { return accelerationStep(dt, q); };
  law.measured << 1.0, 0.0, 0.0;
  law.wanted = law.measured;
  law.prior_sigma << kFar, kFast, kHasty;
  law.sample_sigma = options.sample_sigma;
  return plainMotion<3>(kind, "constant-acceleration", std::move(law));
}

}  // namespace ringhook
