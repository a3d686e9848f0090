#include "prediction/hook_swing.h"

#include <algorithm>
#include <cmath>

namespace ringhook {
namespace {

constexpr double kAnywhere = 10.0;       // [m]; of the first pivot
constexpr double kAnyYaw = 1.0;          // [rad]
constexpr double kLengthRatio = 0.03;    // of the effective lengths about x and y, logarithm
constexpr double kBetweenHooks = 0.3;    // of friction from hook to hook, relative
constexpr double kBetweenSpeeds = 0.02;  // of the belt from hook to hook, relative
constexpr double kAcrossBelt = 0.1;      // of a changing belt's acceleration: its line is not exact
constexpr double kRunning = 0.02;        // [m/s]; slower, the belt's speed says nothing

SwingPrior priorOf(const HookFilterOptions& o) {
  SwingPrior prior;
  const double w = std::sqrt(o.gravity / o.pendulum_length_m);
  for (int axis = 0; axis < 3; ++axis) {
    prior.know(kSwingPivot + axis, 0.0, kAnywhere);
    prior.know(kSwingSpeed + axis, 0.0, o.speed_sigma);
    prior.know(kSwingAcceleration + axis, 0.0, SwingNoise().pivot_acceleration(axis));
  }
  for (int axis = 0; axis < 2; ++axis) {
    prior.know(kSwingAngle + axis, 0.0, o.swing_sigma);
    prior.know(kSwingRate + axis, 0.0, w * o.swing_sigma);
    prior.know(kSwingRest + axis, 0.0, o.rest_sigma);
  }
  prior.know(kSwingLogLength, std::log(o.pendulum_length_m),
             o.length_sigma_m / o.pendulum_length_m);
  prior.know(kSwingLengthRatio, 0.0, kLengthRatio);
  prior.know(kSwingViscous, o.damping_kg_per_s / o.mass_kg, o.viscous_sigma);
  prior.know(kSwingDry, 0.0, o.dry_sigma);
  prior.know(kSwingLonger, 0.0, o.longer_sigma_m);
  prior.know(kSwingYaw, 0.0, kAnyYaw);
  return prior;
}

}  // namespace

SwingFilterOptions swingOptions(const HookFilterOptions& options) {
  SwingFilterOptions swing;
  swing.law.gravity = options.gravity;
  swing.pivot_o = options.pivot_o;
  swing.prior = priorOf(options);
  swing.changing_acceleration = options.belt_change * options.belt_direction_f.cwiseAbs().cwiseMax(
                                                          Eigen::Vector3d::Constant(kAcrossBelt));
  swing.steady.rest_density = options.rest_density;
  swing.steady.yaw_density = options.yaw_density;
  swing.gate = SwingGate(options.gate_probability);
  return swing;
}

SwingFilterOptions swingOptionsAfter(const HookFilterOptions& options, const SwingBelief& learnt) {
  SwingFilterOptions swing = swingOptions(options);
  const auto carry = [&](int place, double spread) {
    swing.prior.know(place, learnt.mean(place), std::hypot(sigmaOf(learnt, place), spread));
  };
  carry(kSwingLogLength, options.next_length_sigma);
  carry(kSwingLengthRatio, options.next_length_sigma);
  for (const int place : {int{kSwingViscous}, int{kSwingDry}}) {
    carry(place, kBetweenHooks * std::abs(learnt.mean(place)));
  }
  const double speed = learnt.mean.segment<3>(kSwingSpeed).norm();
  for (int axis = 0; axis < 3 && speed > kRunning; ++axis) {
    carry(kSwingSpeed + axis, kBetweenSpeeds * speed);
  }
  swing.doubted_prior = swingOptions(options).prior;
  return swing;
}

SwingMeasurement swingMeasurement(const HookFix& fix, const HookFilterOptions& options) {
  SwingMeasurement measurement;
  measurement.time = fix.time;
  measurement.sight = SwingSight::kPose;
  measurement.fMo = options.fMc1 * fix.c1Mo;
  Covariance6 covariance = fix.covariance;
  covariance.diagonal().head<3>().array() += std::pow(options.position_floor_m, 2);
  covariance.diagonal().tail<3>().array() += std::pow(options.rotation_floor_rad, 2);
  measurement.covariance = covariance;
  return measurement;
}

HookEstimate swingEstimate(const SwingBelief& belief, Time time, const HookFilterOptions& options) {
  HookEstimate estimate;
  estimate.time = time;
  estimate.fMo = swingPose(belief.mean, options.pivot_o);
  estimate.twist_f = swingTwist(belief.mean, options.pivot_o);
  estimate.covariance = carried(swingPoseJacobian(belief.mean, options.pivot_o), belief.covariance);
  return estimate;
}

}  // namespace ringhook
