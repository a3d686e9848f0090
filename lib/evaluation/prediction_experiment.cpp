#include "evaluation/prediction_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>

#include "evaluation/prediction_stops.h"
#include "evaluation/prediction_trials.h"
#include "prediction/hook_filter.h"
#include "prediction/linear_motion.h"
#include "prediction/pendulum_motion.h"
#include "prediction/swing_motion.h"
#include "prediction/swing_start.h"

namespace ringhook {
namespace {

constexpr double kSeen = 3.0;        // [s]; before a row's predictions
constexpr double kSeenSecond = 1.0;  // [s]; of a second hook
constexpr double kFar = kPredictionHorizons.back();
constexpr std::size_t kTuningSeeds = 20;

using Maker = std::function<std::unique_ptr<MotionModel>(double density)>;

/// Sums of squares over seeds and coordinates.
struct Sums {
  std::array<double, 3> squares{};
  double said = 0.0;
  double nees = 0.0;
  int count = 0;

  void add(std::size_t horizon, const Eigen::Vector3d& error) {
    squares[horizon] += error.squaredNorm() / 3.0;
  }
  /// At the last horizon. \param covariance of the error, in the same axes [m^2].
  void judge(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance) {
    said += covariance.trace() / 3.0;
    nees += error.dot(covariance.llt().solve(error)) / 3.0;
  }
  void fill(PredictionRow& row) const {
    for (std::size_t i = 0; i < squares.size(); ++i) {
      row.rms_mm[i] = 1e3 * std::sqrt(squares[i] / count);
    }
    row.said_mm = 1e3 * std::sqrt(said / count);
    row.nees = nees / count;
    row.seeds = count;
  }
};

// ---- Points, everything unknown

/// Lets a model see `kSeen` seconds of points and takes its predictions.
void addPointRun(MotionModel& model, Trial trial, Sums& sums) {
  for (int i = 0; i <= trialFrame(kSeen); ++i) {
    const double t = i * kTrialFrame;
    (void)model.update(Time::fromSeconds(t), trial.seenPoint(t)).hasValue();
  }
  for (std::size_t h = 0; h < kPredictionHorizons.size(); ++h) {
    const double then = kSeen + kPredictionHorizons[h];
    const auto belief = model.predict(Time::fromSeconds(then));
    const Eigen::Vector3d mean =
        belief ? Eigen::Vector3d(belief->mean) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    sums.add(h, mean - trial.point(then));
    if (belief && h + 1 == kPredictionHorizons.size()) {
      sums.judge(mean - trial.point(then), belief->covariance);
    }
  }
  ++sums.count;
}

/// Tells how far the whole is, at every run, so that it can be stopped there.
class Pace {
 public:
  explicit Pace(const std::function<void(double)>& progress) : progress_(progress) {}
  void run() const { progress_(at_); }
  void reach(double fraction) {
    at_ = fraction;
    run();
  }

 private:
  const std::function<void(double)>& progress_;
  double at_ = 0.0;
};

std::vector<Trial> makeTrials(const TrialOptions& options, int seeds) {
  std::vector<Trial> trials;
  for (int seed = 1; seed <= seeds; ++seed) {
    trials.push_back(makeTrial(options, static_cast<unsigned>(seed)));
  }
  return trials;
}

Sums pointRuns(const Maker& make, double density, std::span<const Trial> trials, const Pace& pace) {
  Sums sums;
  for (const Trial& trial : trials) {
    pace.run();
    addPointRun(*make(density), trial, sums);
  }
  return sums;
}

/// The density of a grid with which a model is best at the longest horizon: to a peer's favour.
double bestDensity(const Maker& make, std::span<const Trial> trials, const Pace& pace) {
  double best = 1.0;
  double least = std::numeric_limits<double>::infinity();
  for (int power = -9; power <= 3; ++power) {
    const double density = std::pow(10.0, power);
    const Sums sums =
        pointRuns(make, density, trials.first(std::min(kTuningSeeds, trials.size())), pace);
    if (sums.squares.back() < least) {
      least = sums.squares.back();
      best = density;
    }
  }
  return best;
}

/// As the filter begins, but for a belt of which the bound may know that it runs evenly.
SwingPrior evenBelt() {
  SwingPrior prior = unknownSwing(TrajectoryKind::kPoint);
  for (int axis = 0; axis < 3; ++axis) {
    prior.know(kSwingAcceleration + axis, 0.0, 0.0);
  }
  return prior;
}

/// Variance of o at the longest horizon that the Fisher information of one trial's points allows.
double boundVariance(Trial trial) {
  std::vector<SwingMeasurement> seen;
  for (int i = 0; i <= trialFrame(kSeen); ++i) {
    SwingMeasurement m;
    m.time = Time::fromSeconds(i * kTrialFrame);
    m.sight = SwingSight::kPoint;
    m.value = trial.seenPoint(i * kTrialFrame);
    m.covariance = kTrialPositionSigma * kTrialPositionSigma * Eigen::Matrix3d::Identity();
    seen.push_back(m);
  }
  const SwingLaw law;
  const Eigen::Vector3d pivot_o = Eigen::Vector3d::Zero();
  const SwingPrior prior = evenBelt();
  const auto fit = fitSwing(seen, prior, guessSwing(seen, prior, law, pivot_o), law, pivot_o);
  if (!fit) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const SwingTransition ahead = walkSwingWithTransition(fit->end.mean, kFar, law);
  const SwingMatrix P = carried(ahead.Phi, fit->end.covariance);
  const SwingValueJacobian H = swingInnovation(ahead.state, seen.back(), pivot_o).H;
  return (H * P * H.transpose()).trace() / 3.0;
}

void addPointRows(double swing_deg, int seeds, const Pace& pace, std::vector<PredictionRow>& rows) {
  TrialOptions options;
  options.swing_deg = swing_deg;
  const std::vector<Trial> trials = makeTrials(options, seeds);
  const std::string degrees = std::to_string(static_cast<int>(swing_deg));
  const Maker ours = [](double) {
    return makeSwingMotion(TrajectoryKind::kPoint, {kTrialPositionSigma, 9.81});
  };
  const Maker acceleration = [](double density) {
    return makeConstantAcceleration(TrajectoryKind::kPoint, {kTrialPositionSigma, density});
  };
  const Maker report = [](double density) {
    PendulumMotionOptions pendulum;
    pendulum.sample_sigma = kTrialPositionSigma;
    pendulum.swing_density = pendulum.pivot_density = pendulum.height_density = density;
    return makeReportPendulum(TrajectoryKind::kPoint, pendulum);
  };
  const std::pair<const char*, const Maker*> models[] = {{"spherical-pendulum", &ours},
                                                         {"constant-acceleration", &acceleration},
                                                         {"report-pendulum", &report}};
  for (const auto& [name, make] : models) {
    PredictionRow row;
    row.key = "points_" + degrees + "_deg_" + name;
    row.name = "points, " + degrees + " deg, unknown: " + name;
    const double density = make == &ours ? 0.0 : bestDensity(*make, trials, pace);
    pointRuns(*make, density, trials, pace).fill(row);
    if (make == &ours) {
      double bound = 0.0;
      for (const Trial& trial : trials) {
        pace.run();
        bound += boundVariance(trial);
      }
      row.bound_mm = 1e3 * std::sqrt(bound / seeds);
    }
    rows.push_back(row);
  }
}

// ---- Poses, as the product sees them

void addPosePrediction(const HookFilter& filter, const Trial& trial, double now_s, Sums& sums) {
  for (std::size_t h = 0; h < kPredictionHorizons.size(); ++h) {
    const double then = now_s + kPredictionHorizons[h];
    const auto hook = filter.predict(Time::fromSeconds(then));
    sums.add(h, hook ? Eigen::Vector3d(hook->fMo.translation() - trial.point(then))
                     : Eigen::Vector3d(trial.point(then)));
    if (hook && h + 1 == kPredictionHorizons.size()) {
      // The covariance is given in the hook's axes.
      sums.judge(hook->fMo.linear().transpose() * (hook->fMo.translation() - trial.point(then)),
                 hook->covariance.topLeftCorner<3, 3>());
    }
  }
  ++sums.count;
}

void addPoseRow(double swing_deg, int seeds, const Pace& pace, std::vector<PredictionRow>& rows) {
  TrialOptions options;
  options.swing_deg = swing_deg;
  Sums sums;
  for (int seed = 1; seed <= seeds; ++seed) {
    pace.run();
    Trial trial = makeTrial(options, static_cast<unsigned>(seed));
    HookFilter filter(trialHookOptions());
    followTrial(filter, trial, 0.0, kSeen);
    addPosePrediction(filter, trial, kSeen, sums);
  }
  const std::string degrees = std::to_string(static_cast<int>(swing_deg));
  PredictionRow row{"poses_" + degrees + "_deg", "poses, " + degrees + " deg, CAD within 2 %"};
  sums.fill(row);
  rows.push_back(row);
}

/// A hook seen for a second: the first of its kind, or after another one.
void addSecondHookRow(bool after_another, double length_spread, const char* key, const char* name,
                      int seeds, const Pace& pace, std::vector<PredictionRow>& rows) {
  Sums sums;
  TrialOptions options;
  options.length_spread = length_spread;
  options.duration_s = 6.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    pace.run();
    HookFilter filter(trialHookOptions());
    if (after_another) {
      Trial first = makeTrial(options, static_cast<unsigned>(seed) + 100000U);
      followTrial(filter, first, 0.0, 5.0);
      filter.restart();
    }
    Trial trial = makeTrial(options, static_cast<unsigned>(seed));
    followTrial(filter, trial, 0.0, kSeenSecond);
    addPosePrediction(filter, trial, kSeenSecond, sums);
  }
  PredictionRow row{key, name};
  sums.fill(row);
  rows.push_back(row);
}

}  // namespace

PredictionExperiment runPredictionExperiment(const PredictionCounts& counts,
                                             const std::function<void(double)>& progress) {
  PredictionExperiment experiment;
  Pace pace(progress);
  for (const double swing_deg : {5.0, 15.0}) {
    addPointRows(swing_deg, counts.seeds, pace, experiment.rows);
    addPoseRow(swing_deg, counts.seeds, pace, experiment.rows);
    pace.reach(swing_deg < 10.0 ? 0.15 : 0.3);
  }
  addSecondHookRow(false, 0.02, "first_hook_1_s", "poses, first hook, 1 s seen", counts.seeds, pace,
                   experiment.rows);
  addSecondHookRow(true, 0.0, "second_hook_1_s", "poses, second hook of the same length, 1 s seen",
                   counts.seeds, pace, experiment.rows);
  addSecondHookRow(true, 0.02, "second_hook_spread_1_s",
                   "poses, second hook, lengths within 2 %, 1 s seen", counts.seeds, pace,
                   experiment.rows);
  experiment.consistency = consistencyRuns(counts.consistency, [&] { pace.run(); });
  experiment.smoother = smootherRuns(std::min(counts.seeds, 50), [&] { pace.run(); });
  pace.reach(0.5);
  experiment.stop = stopRuns(true, counts.stops, [&](double done) { progress(0.5 + 0.25 * done); });
  experiment.stop_points =
      stopRuns(false, counts.stops, [&](double done) { progress(0.75 + 0.25 * done); });
  return experiment;
}

}  // namespace ringhook
