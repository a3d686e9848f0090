#include "prediction/swing_motion.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "prediction/singer_bank.h"
#include "prediction/swing_filter.h"

namespace ringhook {
namespace {

constexpr int kLostAfter = 15;            // refusals in a row
constexpr int kPivotLostAfter = 5;        // of a pivot that is seen: both jumped
constexpr double kDoubtedLength = 0.02;   // of what was learnt before the track was lost, relative
constexpr double kDoubtedFriction = 0.5;  // likewise
constexpr double kOffLine = 0.1;          // [rad]; a tracked point is seldom right below the pivot
constexpr double kMiddleLength = 0.5;     // [m]; between 0.05 and 5
// No pendulum is one angle: its encoder's disc runs out by 10 um at a radius of 30 mm, its axle has
// play. White in the filter, in truth slow: below it no measurement is better than another.
constexpr double kAngleFloor = 3e-4;  // [rad]
constexpr double kAngleDensity =
    1e-5;                             // white angular acceleration [rad^2/s^3]: 0.01 rad/s^2, 0.1 s
constexpr double kAirDensity = 1e-4;  // the same of a load in a drone's wind

SwingSight sightOf(TrajectoryKind kind) {
  constexpr SwingSight kSights[] = {SwingSight::kOneAngle, SwingSight::kTwoAngles,
                                    SwingSight::kPoint, SwingSight::kPointAndPivot};
  return kSights[static_cast<int>(kind)];
}

SwingPrior angularPrior(TrajectoryKind kind) {
  SwingPrior prior;
  prior.know(kSwingLogLength, std::log(kMiddleLength), 1.0);
  prior.know(kSwingViscous, 0.05, 0.3);
  prior.know(kSwingDry, 0.01, 0.3);
  for (int axis = 0; axis < (kind == TrajectoryKind::kTwoAngles ? 2 : 1); ++axis) {
    prior.know(kSwingAngle + axis, 0.0, 0.5 * std::numbers::pi);
    prior.know(kSwingRate + axis, 0.0, 10.0);
  }
  if (kind == TrajectoryKind::kTwoAngles) {
    prior.know(kSwingLengthRatio, 0.0, 0.03);
  }
  return prior;
}

SwingPrior pointPrior(TrajectoryKind kind) {
  SwingPrior prior = angularPrior(TrajectoryKind::kTwoAngles);
  prior.know(kSwingViscous, 0.05, 0.1);
  prior.know(kSwingDry, 0.01, 0.02);
  for (int axis = 0; axis < 3; ++axis) {
    prior.know(kSwingPivot + axis, 0.0, 10.0);
    prior.know(kSwingSpeed + axis, 0.0, 1.0);
    prior.know(kSwingAcceleration + axis, 0.0,
               kind == TrajectoryKind::kPoint ? SwingNoise().pivot_acceleration(axis) : 1.0);
  }
  for (int axis = 0; axis < 2; ++axis) {
    prior.know(kSwingAngle + axis, 0.0, 0.5);
    prior.know(kSwingRate + axis, 0.0, 3.0);
    prior.know(kSwingRest + axis, 0.0, kind == TrajectoryKind::kPoint ? kOffLine : 0.0);
  }
  prior.know(kSwingLonger, 0.5, kind == TrajectoryKind::kPoint ? 1.0 : 10.0);
  prior.reach_sigma = 0.2;
  return prior;
}

SwingFilterOptions filterOptions(TrajectoryKind kind, const SwingMotionOptions& options) {
  SwingFilterOptions swing;
  swing.law.gravity = options.gravity;
  swing.prior = unknownSwing(kind);
  if (isAngular(kind)) {
    swing.steady.swing_density = kAngleDensity;
    swing.batch_s = 2.0;
    swing.steady.pivot_acceleration.setZero();
    swing.steady.rest_density = swing.steady.yaw_density = 0.0;
    swing.changing_acceleration.setZero();
  } else if (kind == TrajectoryKind::kPointAndPivot) {
    swing.steady.swing_density = kAirDensity;
    swing.batch_s = 0.0;  // the pivot is no straight line, and all is seen at once
    swing.steady.pivot_acceleration.setOnes();
    swing.changing_acceleration.setConstant(3.0);
    swing.gate = SwingGate(1.0 - 1e-12);  // motion capture has no outliers but gaps
  }
  return swing;
}

class SwingMotion final : public MotionModel {
 public:
  SwingMotion(TrajectoryKind kind, const SwingMotionOptions& options)
      : kind_(kind),
        sample_sigma_(isAngular(kind) ? std::hypot(options.sample_sigma, kAngleFloor)
                                      : options.sample_sigma),
        swing_(filterOptions(kind, options)),
        filter_(swing_) {
    if (kind == TrajectoryKind::kPointAndPivot) {
      pivot_.emplace(options.sample_sigma);
    }
  }

  [[nodiscard]] std::string name() const override { return "spherical-pendulum"; }

  Outcome<FilterUpdate> update(Time time, const Eigen::VectorXd& value) override {
    assert(value.size() == valueSize(kind_));
    if (!value.allFinite()) {
      return Refusal{"not finite"};
    }
    if (time_ && time <= *time_) {
      return Refusal{"late or duplicate time stamp"};
    }
    time_ = time;
    watchPivot(time, value);
    const Outcome<SwingUpdate> update = filter_.update(measurementOf(time, value));
    if (!update) {
      if (++refused_in_a_row_ >= (pivot_ ? kPivotLostAfter : kLostAfter)) {
        restart(time, value);
      }
      return Refusal{update.reason()};
    }
    refused_in_a_row_ = 0;
    return update->filter;
  }

  [[nodiscard]] Outcome<Gaussian<Eigen::Dynamic>> predict(Time time) const override {
    const auto state = filter_.state();
    if (!state) {
      return Refusal{"no measurement yet"};
    }
    const SwingBelief ahead = predictSwing(*state, time);
    const SwingSight sight =
        kind_ == TrajectoryKind::kPointAndPivot ? SwingSight::kPoint : sightOf(kind_);
    const SwingValue value = expectedSwingValue(ahead.mean, sight, Eigen::Vector3d::Zero());
    SwingMeasurement there;
    there.sight = sight;
    there.value = value;
    const SwingValueJacobian H = swingInnovation(ahead.mean, there, Eigen::Vector3d::Zero()).H;
    return Gaussian<Eigen::Dynamic>{value, carried(H, ahead.covariance)};
  }

  [[nodiscard]] std::vector<NamedParameter> parameters() const override {
    const auto state = filter_.state();
    if (!state) {
      return {};
    }
    const SwingBelief& b = state->belief;
    const double length = std::exp(b.mean(kSwingLogLength));
    std::vector<NamedParameter> all = {
        {"length_m", length, length * sigmaOf(b, kSwingLogLength)},
        {"damping_per_s", b.mean(kSwingViscous), sigmaOf(b, kSwingViscous)},
        {"dry_friction_rad_s2", b.mean(kSwingDry), sigmaOf(b, kSwingDry)}};
    if (!isAngular(kind_)) {
      all.push_back({"reach_m", b.mean(kSwingLonger), sigmaOf(b, kSwingLonger)});
    }
    return all;
  }

  [[nodiscard]] std::string note() const override {
    return "everything learnt while watching, noise from physics";
  }

 private:
  [[nodiscard]] SwingMeasurement measurementOf(Time time, const Eigen::VectorXd& value) const {
    SwingMeasurement measurement;
    measurement.time = time;
    measurement.sight = sightOf(kind_);
    measurement.value = value;
    measurement.covariance =
        SwingValueCovariance::Identity(value.size(), value.size()) * sample_sigma_ * sample_sigma_;
    if (const auto state = filter_.state(); state && time_sigma_s_ > 0.0) {
      addTimeNoise(predictSwing(*state, time), measurement);
    }
    return measurement;
  }

  /// A sample taken a little late is off by what point and pivot have moved meanwhile.
  void addTimeNoise(const SwingBelief& ahead, SwingMeasurement& measurement) const {
    Eigen::Matrix<double, 6, 1> speed;
    speed << swingTwist(ahead.mean, Eigen::Vector3d::Zero()).head<3>(),
        ahead.mean.segment<3>(kSwingSpeed);
    const Eigen::Matrix<double, 6, 1> off = time_sigma_s_ * speed;
    if (off.allFinite()) {
      measurement.covariance += off * off.transpose();
    }
  }

  void watchPivot(Time time, const Eigen::VectorXd& value) {
    if (!pivot_) {
      return;
    }
    pivot_->update(time, value.tail<3>());
    if (const auto law = pivot_->likeliest()) {
      swing_.law.memory_s = law->memory_s;
      swing_.steady.pivot_acceleration = law->sigma;
      time_sigma_s_ = law->time_sigma_s;
      filter_.setSteady(swing_.steady, law->memory_s);
    }
  }

  /// Anew, with what was learnt of the thing itself.
  void restart(Time time, const Eigen::VectorXd& value) {
    refused_in_a_row_ = 0;
    SwingFilterOptions again = swing_;
    const SwingBelief learnt = filter_.state()->belief;
    const auto carry = [&](int place, double spread) {
      const double wide = std::sqrt(again.prior.covariance(place, place));
      again.prior.know(place, learnt.mean(place),
                       std::min(wide, std::hypot(sigmaOf(learnt, place), spread)));
    };
    carry(kSwingLogLength, kDoubtedLength);
    carry(kSwingLonger, kDoubtedLength * learnt.mean(kSwingLonger));
    carry(kSwingViscous, kDoubtedFriction * std::abs(learnt.mean(kSwingViscous)));
    carry(kSwingDry, kDoubtedFriction * std::abs(learnt.mean(kSwingDry)));
    filter_ = SwingFilter(again);
    static_cast<void>(filter_.update(measurementOf(time, value)));
  }

  TrajectoryKind kind_;
  double sample_sigma_;
  double time_sigma_s_ = 0.0;
  SwingFilterOptions swing_;
  SwingFilter filter_;
  std::optional<SingerBank> pivot_;
  std::optional<Time> time_;
  int refused_in_a_row_ = 0;
};

}  // namespace

SwingPrior unknownSwing(TrajectoryKind kind) {
  return isAngular(kind) ? angularPrior(kind) : pointPrior(kind);
}

std::unique_ptr<MotionModel> makeSwingMotion(TrajectoryKind kind,
                                             const SwingMotionOptions& options) {
  assert(options.sample_sigma > 0.0);
  return std::make_unique<SwingMotion>(kind, options);
}

}  // namespace ringhook
