#include "evaluation/tracking_experiment.h"

#include <cassert>
#include <cmath>
#include <memory>
#include <numeric>

#include "core/error.h"
#include "evaluation/overlay.h"
#include "prediction/constant_velocity.h"
#include "rig/rectifier.h"
#include "sim/cell_world.h"
#include "sim/hook_shape.h"
#include "sim/nominal_rig.h"
#include "sim/sim_stereo_camera.h"
#include "sim/truth.h"
#include "stereo/joint_pose.h"
#include "tracking/marker_tracker.h"

namespace ringhook {
namespace {

constexpr int kPairs = 21;
constexpr double kSpeed = 0.02934;   // [m/s]; one pair a second, so [m] a step as well
constexpr double kFirstY = -0.30;    // of the pivot at the first pair [m]
constexpr double kFirstPair = 1.0;   // [s]
constexpr double kDelivered = 0.01;  // after mid-exposure a pair is there [s]
constexpr int kParabola = 3;         // positions before the first prediction
constexpr double kWander = 0.01;     // of the speed, as a fraction of it, over the sequence
constexpr double kSpeedSigma = 0.5;  // prior of both filters [m/s]
constexpr int kPictureWidth = 800;   // [px]
constexpr double kMilli = 1e3;
/// Where the plates pass in both raw images, with 100 px to spare [px].
constexpr Window kStrip{0, 620, 2048, 420};

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Steps = std::vector<TrackingStep>;

constexpr double kWandered = (kWander * kSpeed) * (kWander * kSpeed);  // by the end [m^2/s^2]
constexpr double kLasts = kPairs - 1;                                  // [s]

/// A point of nearly constant velocity, state (p, v), as constant_acceleration.h has (p, v, a).
class VelocityFilter {
 public:
  [[nodiscard]] Gaussian<6> ahead(double dt) const {
    return kalmanPredict<6>(*belief_, spread(velocityTransition(dt)),
                            spread(whiteAccelerationNoise(dt, kWandered / kLasts)));
  }
  void update(double dt, const Eigen::Vector3d& position, const Eigen::Matrix3d& covariance) {
    if (!belief_) {
      belief_.emplace();
      belief_->mean << position, Eigen::Vector3d::Zero();
      belief_->covariance.setZero();
      belief_->covariance.topLeftCorner<3, 3>() = covariance;
      belief_->covariance.diagonal().tail<3>().setConstant(kSpeedSigma * kSpeedSigma);
      return;
    }
    Eigen::Matrix<double, 3, 6> C = Eigen::Matrix<double, 3, 6>::Zero();
    C.leftCols<3>().setIdentity();
    belief_ = kalmanCorrect<6, 3>(ahead(dt), position, C, covariance).belief;
  }

 private:
  /// Of one axis, for three axes that do not know of each other.
  static Matrix6 spread(const Eigen::Matrix2d& axis) {
    Matrix6 all = Matrix6::Zero();
    for (int row = 0; row < 2; ++row) {
      for (int col = 0; col < 2; ++col) {
        all.block<3, 3>(3 * row, 3 * col).diagonal().setConstant(axis(row, col));
      }
    }
    return all;
  }

  std::optional<Gaussian<6>> belief_;
};

ErrorSpread spreadOf(const std::vector<double>& errors) {
  assert(errors.size() > 1);
  const auto count = static_cast<double>(errors.size());
  ErrorSpread spread;
  spread.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  for (const double error : errors) {
    spread.deviation += (error - spread.mean) * (error - spread.mean) / (count - 1.0);
  }
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

/// Errors of one state over the steps that were predicted.
ErrorSpread predictedSpread(const Steps& steps, std::optional<Vector9> TrackingStep::*predicted,
                            int state) {
  std::vector<double> errors;
  for (const TrackingStep& step : steps) {
    if (const auto& ahead = step.*predicted) {
      errors.push_back(kMilli * std::abs((*ahead)(state)-step.truth(state)));
    }
  }
  return spreadOf(errors);
}

/// The default cell at its gentlest, with one hook that does not swing on an even belt.
CellOptions evenCell(std::uint64_t seed) {
  CellOptions options;
  options.seed = seed;
  options.belt.speed = kSpeed;
  options.belt.speed_spread = 0.0;
  options.belt.start_y = options.belt.entry_y = kFirstY - kSpeed * kFirstPair;
  options.hook.count = 1;
  options.hook.swing_about_x = options.hook.swing_about_y = 0.0;
  return options;
}

TagPlate hookPlate() {
  const HookShape shape;
  TagPlate plate;
  plate.oMk = shape.oMk();
  for (const int id : {0, 1}) {
    PlateTag tag{id, shape.tag_size, Pose::Identity()};
    tag.kMtag.translation().y() = (id - 0.5) * shape.tag_distance;
    plate.tags.push_back(tag);
  }
  return plate;
}

/// Position, velocity and acceleration in f of a point of the hook, `before` being the truth one
/// second ago: neither belt nor hook accelerates here, so the mean over that second will do.
Vector9 truthOf(const HookTruth& hook, const HookTruth& before, const Eigen::Vector3d& point_o) {
  const auto velocity = [&](const HookTruth& h) -> Eigen::Vector3d {
    const Eigen::Vector3d arm = h.fMo.linear() * point_o;
    return h.twist_f.head<3>() + Eigen::Vector3d(h.twist_f.tail<3>()).cross(arm);
  };
  Vector9 state;
  state << hook.fMo * point_o, velocity(hook), velocity(hook) - velocity(before);
  return state;
}

/// Of a point of the hook, in f [m^2]: the twist d moves it by v + w x point.
Eigen::Matrix3d positionCovariance(const HookFix& fix, const Pose& fMo,
                                   const Eigen::Vector3d& point_o) {
  Eigen::Matrix<double, 3, 6> J;
  J << fMo.linear(), -fMo.linear() * skew(point_o);
  return carried(J, fix.covariance);
}

/// Cell, cameras and the way from pictures to fixes.
class Passage {
 public:
  explicit Passage(std::uint64_t seed)
      : seed_(seed),
        told_(nominalRig()),
        true_(disturbedRig(told_, seed)),
        world_(evenCell(seed)),
        rectifier_(told_),
        tracker_(hookPlate()) {
    world_.every(1.0, 0.0, [this](Time) { past_.push_back(truth(world_).hooks.front()); });
    SimCameraOptions options;
    options.rate_hz = 1.0;
    camera_ = std::make_unique<SimStereoCamera>(world_, true_, options);
    camera_->setWindows(kStrip, kStrip);
  }

  TrackingSequence run() {
    TrackingSequence sequence;
    sequence.seed = seed_;
    for (int i = 0; i < kPairs; ++i) {
      const Snapshot pair = fixAt(Time::fromSeconds(kFirstPair + i));
      addSteps(pair.fix, sequence);
      if (i == 0) {
        sequence.first_png = overlayPng(pair, kPictureWidth);
      } else if (i == kPairs - 1) {
        sequence.last_png = overlayPng(pair, kPictureWidth);
      }
    }
    for (TrackingCase& view : sequence.views) {
      predictSteps(view.steps);
      view.errors = errorsOf(view.steps);
    }
    return sequence;
  }

 private:
  Snapshot fixAt(Time time) {
    world_.advanceTo(time + kDelivered);
    std::optional<StereoFrame> frame;
    while (!frame || frame->time < time) {
      frame = camera_->grab(0.0);
      if (!frame) {
        throw Error("the simulated cameras delivered no pair at " + std::to_string(time.seconds()) +
                    " s");
      }
    }
    const RectifiedFrame rectified = rectifier_.rectify(*frame);
    const auto view = tracker_.track(rectified, std::nullopt);
    const auto fix = view ? fixFromView(*view) : Outcome<HookFix>(Refusal{view.reason()});
    if (!fix) {
      throw Error("the simulated pair at " + std::to_string(time.seconds()) +
                  " s shows no hook: " + fix.reason());
    }
    return {rectified.views.front(), *view, *fix};
  }

  void addSteps(const HookFix& fix, TrackingSequence& sequence) const {
    const Eigen::Vector3d plate_o = HookShape{}.oMk().translation();
    const auto add = [&](TrackingView view, const StereoRig& rig, const Eigen::Vector3d& point_o) {
      const Pose fMo = *rig.fMc1 * fix.c1Mo;
      TrackingStep step;
      step.truth = truthOf(past_.back(), past_[past_.size() - 2], point_o);
      step.seen_f = fMo * point_o;
      step.covariance_f = positionCovariance(fix, fMo, point_o);
      step.features = fix.features;
      sequence.views[view].steps.push_back(step);
    };
    add(kPlateAsTold, told_, plate_o);
    add(kPlateTrueRig, true_, plate_o);
    add(kHookAsTold, told_, Eigen::Vector3d::Zero());
  }

  std::uint64_t seed_;
  StereoRig told_;
  StereoRig true_;
  CellWorld world_;
  Rectifier rectifier_;
  MarkerTracker tracker_;
  std::vector<HookTruth> past_;  ///< once a second
  std::unique_ptr<SimStereoCamera> camera_;
};

}  // namespace

ErrorSpread meanOf(std::span<const ErrorSpread> spreads) {
  ErrorSpread mean;
  for (const ErrorSpread& spread : spreads) {
    mean.mean += spread.mean / static_cast<double>(spreads.size());
    mean.deviation += spread.deviation / static_cast<double>(spreads.size());
  }
  return mean;
}

void predictSteps(std::vector<TrackingStep>& steps) {
  ConstantAccelerationOptions options;
  options.jerk_density = 3.0 * kWandered / std::pow(kLasts, 3);
  options.speed_sigma = kSpeedSigma;
  options.acceleration_sigma = std::sqrt(options.jerk_density * kLasts);
  ConstantAccelerationFilter acceleration(options);
  VelocityFilter velocity;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    TrackingStep& step = steps[i];
    const Time time = Time::fromSeconds(static_cast<double>(i));
    if (i >= kParabola) {
      step.by_acceleration = acceleration.predict(time)->mean;
      step.by_velocity.emplace(Vector9::Zero());
      step.by_velocity->head<6>() = velocity.ahead(1.0).mean;
    }
    step.nis = acceleration.update(time, step.seen_f, step.covariance_f)->nis;
    velocity.update(1.0, step.seen_f, step.covariance_f);
  }
}

TrackingErrors errorsOf(const std::vector<TrackingStep>& steps) {
  TrackingErrors errors;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> seen;
    for (const TrackingStep& step : steps) {
      seen.push_back(kMilli * std::abs(step.seen_f(axis) - step.truth(axis)));
    }
    errors.seen[static_cast<std::size_t>(axis)] = spreadOf(seen);
  }
  std::vector<double> distances;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const double seen = (steps[i].seen_f - steps[i - 1].seen_f).norm();
    const double real = (steps[i].truth - steps[i - 1].truth).head<3>().norm();
    distances.push_back(kMilli * std::abs(seen - real));
  }
  errors.distance = spreadOf(distances);
  for (int state = 0; state < 9; ++state) {
    const auto at = static_cast<std::size_t>(state);
    errors.by_acceleration[at] = predictedSpread(steps, &TrackingStep::by_acceleration, state);
    errors.by_velocity[at] = predictedSpread(steps, &TrackingStep::by_velocity, state);
  }
  const auto judged = static_cast<double>(steps.size() - kParabola);
  for (std::size_t i = kParabola; i < steps.size(); ++i) {
    errors.nis += steps[i].nis / (3.0 * judged);
  }
  return errors;
}

TrackingExperiment runTrackingExperiment(const TrackingOptions& options) {
  TrackingExperiment experiment;
  for (int i = 0; i < options.sequences; ++i) {
    if (options.step) {
      options.step(static_cast<double>(i) / options.sequences);
    }
    experiment.sequences.push_back(
        Passage(options.first_seed + static_cast<std::uint64_t>(i)).run());
  }
  return experiment;
}

}  // namespace ringhook
