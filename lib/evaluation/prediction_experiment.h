#pragma once

/// \file
/// How well is the swinging, travelling hook predicted? Many seeded hooks of the simulated physics
/// (sim/hook_world.h: MuJoCo, distributed mass, dry and viscous friction, air), seen at 50 Hz with
/// 0.2 mm of noise per axis on the belt of 0.2 m/s; everything unknown means that neither length,
/// friction, belt, pivot nor swing is told. Beside our filter: constant acceleration and the
/// report's pendulum on the same samples, each with the process noise that suits it best here.
/// The bound is Cramer and Rao's for the same samples and the same unknowns: the inverse Fisher
/// information of a batch fit (swing_start.h), carried to the predicted instant.

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ringhook {

/// [s]
inline constexpr std::array<double, 3> kPredictionHorizons = {0.033, 0.1, 0.3};

/// One kind of run, over all its seeds.
struct PredictionRow {
  std::string key;                 ///< of its table in the JSON: "swing_5_deg"
  std::string name;                ///< what was seen and by whom it was predicted
  std::array<double, 3> rms_mm{};  ///< per coordinate, at the horizons
  double said_mm = 0.0;            ///< what the filter itself said at the last horizon, RMS
  double nees = 0.0;               ///< mean, per degree of freedom, at the last horizon
  double bound_mm = 0.0;           ///< Cramer-Rao at the last horizon; 0: not computed
  int seeds = 0;
};

/// A belt that stops in the middle.
struct StopResult {
  int seeds = 0;
  int noticed = 0;            ///< runs in which the filter told a change of speed
  int gated = 0;              ///< runs in which the NIS gate fired
  int back = 0;               ///< runs below 1 mm at 300 ms, from one second after the stop on
  int diverged = 0;           ///< runs whose error at 300 ms exceeds 20 mm a second after the stop
  double rms_after_mm = 0.0;  ///< at 300 ms from one second after the stop on, per coordinate
  double worst_mm = 0.0;      ///< largest of these
  /// RMS at 300 ms over the seeds, 20 ms apart, from the stop's beginning [mm].
  std::vector<double> course_mm;
};

struct ConsistencyResult {
  int seeds = 0;
  int inside = 0;         ///< runs whose mean NIS lies in its 95 % band
  double nis_mean = 0.0;  ///< per degree of freedom
  /// Mean normalised error of the estimated pose at each run's end, squared (NEES), per degree of
  /// freedom; 1 if the filter's covariance is what it errs by.
  double nees_mean = 0.0;
  std::array<double, 2> nees_band{};  ///< 95 % of consistent filters give a mean in between
};

/// Where the hook was, judged then and afterwards: RMS per coordinate of o [mm].
struct SmootherResult {
  int seeds = 0;
  double filter_mm = 0.0;    ///< by the filter, at the time
  double smoother_mm = 0.0;  ///< by the smoother, from all measurements
};

struct PredictionExperiment {
  std::vector<PredictionRow> rows;
  StopResult stop;         ///< poses seen
  StopResult stop_points;  ///< points seen, everything unknown; events are not told there
  ConsistencyResult consistency;
  SmootherResult smoother;
};

struct PredictionCounts {
  int seeds = 200;        ///< of each row
  int stops = 1000;       ///< belts that stop
  int consistency = 500;  ///< runs for the NIS
};

/// Some minutes of work; `progress` is told the fraction done.
PredictionExperiment runPredictionExperiment(const PredictionCounts& counts,
                                             const std::function<void(double)>& progress);

/// What to print.
std::string predictionTable(const PredictionExperiment& experiment);
/// summary.json.
std::string predictionJson(const PredictionExperiment& experiment);
/// summary.json, stop.csv and report.html. Throws InputError if the folder is no good.
void writePredictionOutputs(const std::filesystem::path& folder,
                            const PredictionExperiment& experiment);

}  // namespace ringhook
