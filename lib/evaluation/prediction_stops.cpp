#include "evaluation/prediction_stops.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "evaluation/prediction_trials.h"
#include "prediction/chi_square.h"
#include "prediction/hook_swing.h"
#include "prediction/swing_motion.h"
#include "prediction/swing_smoother.h"

namespace ringhook {
namespace {

constexpr double kStop = 4.0;  // [s]; the belt begins to stop
constexpr double kFar = kPredictionHorizons.back();

/// What follows a hook while the belt stops.
struct Follower {
  std::function<bool(Trial&, double)> see;               ///< true if the gate let it pass
  std::function<Eigen::Vector3d(double)> predict;        ///< o at that time [m]
  std::function<bool()> noticed = [] { return false; };  ///< a change of speed, just now
};

/// RMS per coordinate at the longest horizon, one frame after the other from the stop on [m].
std::vector<double> followStop(const Follower& follower, Trial& trial, double until_s,
                               StopResult& result) {
  std::vector<double> errors;
  bool noticed = false;
  bool gated = false;
  for (int i = 0; i <= trialFrame(until_s); ++i) {
    const double t = i * kTrialFrame;
    const bool passed = follower.see(trial, t);
    if (t < kStop) {
      continue;
    }
    gated = gated || !passed;
    noticed = noticed || follower.noticed();
    errors.push_back((follower.predict(t + kFar) - trial.point(t + kFar)).norm() / std::sqrt(3.0));
  }
  result.noticed += noticed;
  result.gated += gated;
  return errors;
}

Follower poseFollower(HookFilter& filter) {
  return {[&filter](Trial& trial, double t) { return filter.update(trial.seenPose(t)).hasValue(); },
          [&filter](double t) {
            const auto hook = filter.predict(Time::fromSeconds(t));
            return hook ? Eigen::Vector3d(hook->fMo.translation())
                        : Eigen::Vector3d(Eigen::Vector3d::Zero());
          },
          [&filter] { return filter.lastEvent() == SwingEvent::kSpeedChange; }};
}

Follower pointFollower(MotionModel& model) {
  return {[&model](Trial& trial, double t) {
            return model.update(Time::fromSeconds(t), trial.seenPoint(t)).hasValue();
          },
          [&model](double t) {
            const auto belief = model.predict(Time::fromSeconds(t));
            return belief ? Eigen::Vector3d(belief->mean)
                          : Eigen::Vector3d(Eigen::Vector3d::Zero());
          }};
}

}  // namespace

StopResult stopRuns(bool poses, int seeds, const std::function<void(double)>& progress) {
  TrialOptions options;
  options.stop_at_s = kStop;
  BeltProfile belt;
  belt.initial_speed = options.belt_speed;
  const double settled = changeDuration(belt, options.belt_speed) + 1.0;  // after the stop began
  const double until = kStop + settled + 1.0;
  options.duration_s = until + kFar + 0.1;
  StopResult result;
  double after = 0.0;
  int count = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    progress(static_cast<double>(seed) / seeds);
    Trial trial = makeTrial(options, static_cast<unsigned>(seed));
    HookFilter filter(trialHookOptions());
    const auto model = makeSwingMotion(TrajectoryKind::kPoint, {kTrialPositionSigma, 9.81});
    const std::vector<double> errors =
        followStop(poses ? poseFollower(filter) : pointFollower(*model), trial, until, result);
    result.course_mm.resize(errors.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      result.course_mm[i] += errors[i] * errors[i];
      if (static_cast<double>(i) * kTrialFrame >= settled) {
        worst = std::max(worst, errors[i]);
        after += errors[i] * errors[i];
        ++count;
      }
    }
    result.back += worst < 1e-3;
    result.diverged += worst > 20e-3;
    result.worst_mm = std::max(result.worst_mm, 1e3 * worst);
  }
  result.seeds = seeds;
  result.rms_after_mm = 1e3 * std::sqrt(after / count);
  for (double& value : result.course_mm) {
    value = 1e3 * std::sqrt(value / seeds);
  }
  return result;
}

ConsistencyResult consistencyRuns(int seeds, const std::function<void()>& step) {
  constexpr double kFrom = 1.5;
  constexpr double kUntil = 5.0;
  TrialOptions options;
  options.duration_s = kUntil + 0.1;
  ConsistencyResult result;
  for (int seed = 1; seed <= seeds; ++seed) {
    step();
    Trial trial = makeTrial(options, static_cast<unsigned>(seed));
    HookFilter filter(trialHookOptions());
    followTrial(filter, trial, 0.0, kFrom);
    double sum = 0.0;
    int fixes = 0;
    for (int i = trialFrame(kFrom) + 1; i <= trialFrame(kUntil); ++i, ++fixes) {
      (void)filter.update(trial.seenPose(i * kTrialFrame)).hasValue();
      sum += filter.lastNis();
    }
    const double degrees = 6.0 * fixes;
    result.inside +=
        sum > chiSquareQuantile(0.025, degrees) && sum < chiSquareQuantile(0.975, degrees);
    result.nis_mean += sum / degrees;
    const HookEstimate end = filter.predict(Time::fromSeconds(kUntil)).value();
    const Twist error = logSe3(end.fMo.inverse() * trial.pose(kUntil));
    result.nees_mean += error.dot(end.covariance.llt().solve(error)) / 6.0;
    ++result.seeds;
  }
  result.nis_mean /= result.seeds;
  result.nees_mean /= result.seeds;
  const double all = 6.0 * result.seeds;
  result.nees_band = {chiSquareQuantile(0.025, all) / all, chiSquareQuantile(0.975, all) / all};
  return result;
}

SmootherResult smootherRuns(int seeds, const std::function<void()>& step) {
  constexpr double kFrom = 1.0;
  constexpr double kUntil = 3.0;
  constexpr double kEnd = 4.0;
  TrialOptions options;
  options.duration_s = kEnd + 0.1;
  const HookFilterOptions hook = trialHookOptions();
  SmootherResult result;
  int count = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    step();
    Trial trial = makeTrial(options, static_cast<unsigned>(seed));
    HookFilter filter(hook);
    std::vector<SwingMeasurement> seen;
    std::vector<Eigen::Vector3d> then;
    for (int i = 0; i <= trialFrame(kEnd); ++i) {
      const HookFix fix = trial.seenPose(i * kTrialFrame);
      (void)filter.update(fix).hasValue();
      seen.push_back(swingMeasurement(fix, hook));
      then.push_back(filter.predict(fix.time)->fMo.translation());
    }
    const auto smoothed = smoothSwing(seen, swingOptions(hook), SwingMode::kSteady);
    if (!smoothed) {
      continue;
    }
    ++result.seeds;
    for (int i = trialFrame(kFrom); i <= trialFrame(kUntil); ++i, ++count) {
      const auto k = static_cast<std::size_t>(i);
      const Eigen::Vector3d truth = trial.point(i * kTrialFrame);
      const Eigen::Vector3d after = swingPose((*smoothed)[k].mean, hook.pivot_o).translation();
      result.filter_mm += (then[k] - truth).squaredNorm() / 3.0;
      result.smoother_mm += (after - truth).squaredNorm() / 3.0;
    }
  }
  result.filter_mm = 1e3 * std::sqrt(result.filter_mm / count);
  result.smoother_mm = 1e3 * std::sqrt(result.smoother_mm / count);
  return result;
}

}  // namespace ringhook
